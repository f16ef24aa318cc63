// Decoders of the messages of a channel by its schema, and the checks of schemas against the public ones.
import {parse} from '@foxglove/rosmsg';
import {ros2humble} from '@foxglove/rosmsg-msgs-common';
import {MessageReader, MessageWriter} from '@foxglove/rosmsg2-serialization';
import * as foxglove from '@foxglove/schemas/internal.js';
import {protobufFromBinaryDescriptor} from '@mcap/support';
import protobuf from 'protobufjs';

const fail = (why) => { throw new Error(why); };

// Foxglove's own definitions, as .proto texts.
const known = new protobuf.Root();
const {generateProto, foxgloveMessageSchemas, foxgloveEnumSchemas} = foxglove.default ?? foxglove;
for (const schema of Object.values(foxgloveMessageSchemas)) {
  const enums = Object.values(foxgloveEnumSchemas).filter((e) => e.parentSchemaName === schema.name);
  protobuf.parse(generateProto(schema, enums), known, {keepCase: true});
}
const wellKnown = ['Timestamp', 'Duration'];
for (const name of wellKnown) known.addJSON(protobuf.common.get(`google/protobuf/${name.toLowerCase()}.proto`).nested);

const shape = (type) => type.fieldsArray
  .map((f) => `${f.name} ${f.id} ${f.resolve().resolvedType?.fullName ?? f.type} ${f.repeated}`).sort().join('\n');

// Throws unless a type and all types in it have exactly the fields of the public definition.
function compareWithFoxglove(type, seen = new Set()) {
  if (seen.has(type.fullName)) return;
  seen.add(type.fullName);
  if (!type.fullName.startsWith('.hedgehop')) {
    const other = known.lookupType(type.fullName);
    if (shape(type) !== shape(other)) fail(`${type.fullName}: ${shape(type)}\ninstead of\n${shape(other)}`);
    for (const e of type.nestedArray.filter((n) => n instanceof protobuf.Enum)) {
      if (JSON.stringify(e.values) !== JSON.stringify(other.lookupEnum(e.name).values)) fail(`enum ${e.fullName}`);
    }
  }
  for (const field of type.fieldsArray) {
    if (field.resolvedType instanceof protobuf.Type) compareWithFoxglove(field.resolvedType, seen);
  }
}

// Throws if the bytes have a field that the type lacks, at any depth: protobufjs skips such fields.
function checkFields(type, bytes) {
  const wire = {double: 1, fixed32: 5, bool: 0, int64: 0, int32: 0, string: 2, bytes: 2};
  const reader = protobuf.Reader.create(bytes);
  while (reader.pos < reader.len) {
    const tag = reader.uint32(), field = type.fieldsById[tag >>> 3];
    if (!field) fail(`${type.fullName}: unknown field ${tag >>> 3}`);
    const inner = field.resolve().resolvedType;
    const packed = field.repeated && !inner && !['string', 'bytes'].includes(field.type);
    const expected = packed ? 2 : inner instanceof protobuf.Enum ? 0 : inner ? 2 : wire[field.type];
    if ((tag & 7) !== expected) fail(`${type.fullName}.${field.name}: wire type ${tag & 7} instead of ${expected}`);
    if (inner instanceof protobuf.Type) checkFields(inner, reader.bytes());
    else reader.skipType(tag & 7);
  }
}

function protobufDecoder(schema) {
  const type = protobufFromBinaryDescriptor(schema.data).lookupType(schema.name);
  compareWithFoxglove(type);
  return (bytes) => {
    checkFields(type, bytes);
    return type.toObject(type.decode(bytes), {longs: Number, defaults: true});
  };
}

const withoutConstants = (definitions) => definitions
  .map((d) => [d.name, d.definitions.filter((f) => !f.isConstant)
    .map((f) => [f.type, f.name, f.isArray ?? false, f.arrayLength ?? 0, f.isComplex ?? false])]);

// ROS messages must have the fields of ROS 2 Humble, and equal bytes when another writer writes them again.
function rosDecoder(schema) {
  const definitions = parse(new TextDecoder().decode(schema.data), {ros2: true});
  for (const [name, fields] of withoutConstants(definitions)) {
    const public_ = ros2humble[name ?? schema.name] ?? ros2humble[(name ?? schema.name).replace('/msg/', '/')] ??
      Object.values(ros2humble).find((d) => d.name === (name ?? schema.name));
    if (!public_) fail(`${name ?? schema.name}: not a type of ROS 2`);
    const expected = withoutConstants([public_])[0][1];
    if (JSON.stringify(fields) !== JSON.stringify(expected)) {
      fail(`${schema.name} ${name}: ${JSON.stringify(fields)} instead of ${JSON.stringify(expected)}`);
    }
  }
  const reader = new MessageReader(definitions), writer = new MessageWriter(definitions);
  return (bytes) => {
    const message = reader.readMessage(bytes);
    if (Buffer.compare(Buffer.from(writer.writeMessage(message)), Buffer.from(bytes)) !== 0) {
      fail(`${schema.name}: other bytes when written again`);
    }
    return message;
  };
}

export function decoder(channel, schema) {
  const pair = `${channel.messageEncoding} ${schema.encoding}`;
  if (pair === 'protobuf protobuf') return protobufDecoder(schema);
  if (pair === 'cdr ros2msg') return rosDecoder(schema);
  return fail(`unknown encodings: ${pair}`);
}
