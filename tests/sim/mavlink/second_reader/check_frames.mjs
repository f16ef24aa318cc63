// Reads each frame that a program writes with node-mavlink, compares all fields, and writes the frame again:
//   node check_frames.mjs PROGRAM
import {execFileSync} from 'node:child_process';
import {Readable} from 'node:stream';
import {MavLinkPacketParser, MavLinkPacketSplitter, MavLinkProtocolV2, ardupilotmega, common, minimal} from 'node-mavlink';

const registry = {...minimal.REGISTRY, ...common.REGISTRY, ...ardupilotmega.REGISTRY};
const samples = execFileSync(process.argv[2], {encoding: 'utf8'}).trim().split('\n').map(line => JSON.parse(line));


function same(ours, theirs) {
  if (Array.isArray(ours)) return ours.length === theirs.length && ours.every((value, i) => same(value, theirs[i]));
  if (typeof theirs === 'number' && !Number.isInteger(theirs)) return Math.fround(Number(ours)) === theirs;
  return String(ours) === String(theirs);
}

const stream = Readable.from(samples.map(sample => Buffer.from(sample.hex, 'hex')));
const packets = [];
for await (const packet of stream.pipe(new MavLinkPacketSplitter()).pipe(new MavLinkPacketParser())) packets.push(packet);

let faults = 0;
const fault = (...words) => {
  faults += 1;
  console.error(...words);
};
if (packets.length !== samples.length) fault(`${packets.length} of ${samples.length} frames read`);
packets.forEach((packet, i) => {
  const sample = samples[i], type = registry[packet.header.msgid];
  if (type?.MSG_NAME !== sample.name) return fault(`${sample.name} is read as ${type?.MSG_NAME}`);
  const message = packet.protocol.data(packet.payload, type);
  for (const field of type.FIELDS) {
    const ours = sample.fields[field.source], theirs = message[field.name];
    if (ours === undefined ? !/^chan(9|1\d)_raw$/.test(field.source) : !same(ours, theirs)) {
      fault(`${sample.name}.${field.source}: ${ours} is read as ${theirs}`);
    }
  }
  if (packet.header.payloadLength === 1 && packet.payload[0] === 0) return;  // it writes no byte; the definition keeps one
  const again = new MavLinkProtocolV2(packet.header.sysid, packet.header.compid).serialize(message, packet.header.seq);
  if (again.toString('hex') !== sample.hex) fault(`${sample.name}: ${sample.hex} is written as ${again.toString('hex')}`);
});
console.log(`${packets.length} frames of ${new Set(samples.map(sample => sample.name)).size} messages, ${faults} differences`);
process.exit(faults === 0 && packets.length > 0 ? 0 : 1);
