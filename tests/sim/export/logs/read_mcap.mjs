// Reads an MCAP file with both readers of @mcap/core and prints it as JSON. Throws if they differ, a CRC is wrong, or a
// message does not decode by its own schema: node read_mcap.mjs FILE
import {readFileSync} from 'node:fs';
import {crc32} from '@foxglove/crc';
import {McapIndexedReader, McapStreamReader} from '@mcap/core';
import {loadDecompressHandlers} from '@mcap/support';
import {decoder} from './decoders.mjs';

const bytes = readFileSync(process.argv[2]);
const decompressHandlers = await loadDecompressHandlers();
const fail = (why) => { throw new Error(why); };

// The stream reader checks the CRCs of chunks and attachments.
const stream = new McapStreamReader({decompressHandlers, validateCrcs: true, includeChunks: true});
const records = [];
stream.append(bytes);
for (let record; (record = stream.nextRecord()) != undefined;) records.push(record);
if (!stream.done()) fail('the file ends within a record');
const of = (type) => records.filter((record) => record.type === type);

// The CRCs of the data and of the summary, over the bytes themselves.
const footer = of('Footer')[0], kFooterBytes = 1 + 8 + 20, kMagicBytes = 8, kDataEndBytes = 1 + 8 + 4;
const footerAt = bytes.length - kMagicBytes - kFooterBytes;
const dataEndAt = (footer.summaryStart ? Number(footer.summaryStart) : footerAt) - kDataEndBytes;
if (of('DataEnd')[0].dataSectionCrc !== crc32(bytes.subarray(0, dataEndAt))) fail('wrong CRC of the data');
const summaryCrc = crc32(bytes.subarray(footer.summaryStart ? Number(footer.summaryStart) : footerAt,
                                        bytes.length - kMagicBytes - 4));
if (footer.summaryCrc !== summaryCrc) fail('wrong CRC of the summary');

// The indexed reader uses the indexes of chunks and messages only.
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, length) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + length))),
};
const indexed = await McapIndexedReader.Initialize({readable, decompressHandlers});
const key = (m) => `${m.logTime} ${m.channelId} ${m.sequence} ${m.publishTime} ${crc32(m.data)} ${m.data.length}`;
const streamed = of('Message').map(key), read = [];
for await (const message of indexed.readMessages({validateCrcs: true})) read.push(key(message));
if (streamed.length === 0) fail('no message');
if (JSON.stringify([...streamed].sort()) !== JSON.stringify([...read].sort())) fail('the two readers differ');
for (const summary of of('SummaryOffset')) {
  const first = bytes[Number(summary.groupStart)];
  if (first !== summary.groupOpcode) fail(`the summary offset of ${summary.groupOpcode} leads to ${first}`);
}

// Statistics.
const statistics = indexed.statistics, counts = new Map();
for (const {channelId} of of('Message')) counts.set(channelId, (counts.get(channelId) ?? 0n) + 1n);
const times = of('Message').map((m) => m.logTime);
const least = times.reduce((a, b) => (a < b ? a : b)), most = times.reduce((a, b) => (a > b ? a : b));
if (statistics.messageCount !== BigInt(streamed.length) || statistics.chunkCount !== of('Chunk').length ||
    statistics.messageStartTime !== least || statistics.messageEndTime !== most ||
    [...counts].some(([id, count]) => statistics.channelMessageCounts.get(id) !== count) ||
    statistics.channelCount !== counts.size) fail('wrong statistics');

// Every message by its own schema.
const topics = {};
const decoders = new Map();
for (const message of of('Message')) {
  const channel = indexed.channelsById.get(message.channelId);
  const schema = indexed.schemasById.get(channel.schemaId);
  if (!decoders.has(channel.id)) decoders.set(channel.id, decoder(channel, schema));
  const topic = (topics[channel.topic] ??= {schema: schema.name, metadata: Object.fromEntries(channel.metadata), messages: []});
  topic.messages.push([Number(message.logTime), decoders.get(channel.id)(message.data)]);
}
const attachments = {}, metadata = {};
for await (const a of indexed.readAttachments({validateCrcs: true})) attachments[a.name] = Buffer.from(a.data).toString();
for await (const m of indexed.readMetadata()) metadata[m.name] = Object.fromEntries(m.metadata);
const sorted = times.every((t, i) => i === 0 || t >= times[i - 1]);
const largest = Math.max(...of('Chunk').map((c) => Number(c.uncompressedSize)));
const plain = (name, value) => {
  if (typeof value === 'bigint') return Number(value);
  if (typeof value === 'number' && !Number.isFinite(value)) return String(value);  // JSON has neither NaN nor infinity
  if (value instanceof Uint8Array) return {base64: Buffer.from(value).toString('base64')};
  return ArrayBuffer.isView(value) ? Array.from(value) : value;
};
console.log(JSON.stringify({profile: indexed.header.profile, library: indexed.header.library, topics, attachments, metadata,
                            chunks: of('Chunk').length, sorted, largest, compression: of('Chunk')[0].compression}, plain));
