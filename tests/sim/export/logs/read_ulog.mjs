// Prints a ULog file as JSON, read by @foxglove/ulog: node read_ulog.mjs FILE
import {ULog} from '@foxglove/ulog';
import {FileReader} from '@foxglove/ulog/node.js';

const log = new ULog(new FileReader(process.argv[2]));
await log.open();
const topics = {}, texts = [];
for (const {name} of log.subscriptions.values()) topics[name] = [];
const kText = 'L'.charCodeAt(0), kData = 'D'.charCodeAt(0);
for await (const message of log.readMessages()) {
  if (message.type === kText) texts.push([Number(message.timestamp), message.logLevel, message.message]);
  if (message.type === kData) topics[log.subscriptions.get(message.msgId).name].push(message.value);
}
const plain = (name, value) => {
  if (typeof value === 'bigint') return Number(value);
  return ArrayBuffer.isView(value) ? Array.from(value) : value;
};
console.log(JSON.stringify({start: log.header.timestamp, information: Object.fromEntries(log.header.information), topics, texts},
                           plain));
