// check_export.js LOG MCAP DETECTIONS.csv: an exported flight, read by Foxglove's implementation as a stream (which checks every CRC) and by
// its index, and compared with the log and the detections that it was made from. Its schemas must be those of @foxglove/schemas.
const assert = require('assert');
const fs = require('fs');
const {McapStreamReader, McapIndexedReader} = require('@mcap/core');
const {loadDecompressHandlers} = require('@mcap/support');
const {parse} = require('@foxglove/rosmsg');
const {MessageReader} = require('@foxglove/rosmsg2-serialization');
const {foxgloveMessageSchemas, generateRosMsgMergedSchema} = require('@foxglove/schemas/internal');
const {readLog, MJPEG} = require('./lcm_log.js');

const [log, file, csv] = process.argv.slice(2);

function fieldsOf(definition) {
  return definition.definitions.filter(d => !d.isConstant).map(d => `${d.type.replace('/msg/', '/')}${d.isArray ? '[]' : ''} ${d.name}`);
}

/** Every definition that Foxglove's schema has is here, field for field. */
function compareSchema(name, text) {
  const theirs = parse(generateRosMsgMergedSchema(foxgloveMessageSchemas[name], {rosVersion: 2}), {ros2: true});
  const ours = parse(text, {ros2: true});
  const find = (all, wanted) => all.find(d => (d.name ?? '').replace('/msg/', '/') === wanted);
  assert.deepStrictEqual(fieldsOf(ours.find(d => d.name === undefined)), fieldsOf(theirs.find(d => d.name === undefined)), name);
  for (const definition of theirs.filter(d => d.name !== undefined)) {
    const wanted = definition.name.replace('/msg/', '/');
    const found = find(ours, wanted);
    assert(found, `${name}: no definition of ${wanted}`);
    assert.deepStrictEqual(fieldsOf(found), fieldsOf(definition), wanted);
  }
}

const utimeOf = time => time.sec * 1e6 + Math.round(time.nanosec / 1e3);

async function main() {
  const decompressHandlers = await loadDecompressHandlers();
  const bytes = fs.readFileSync(file);

  const stream = new McapStreamReader({decompressHandlers, validateCrcs: true});
  stream.append(bytes);
  const schemas = new Map(), channels = new Map(), messages = new Map(), kinds = {};
  let streamed = 0;
  for (let record; (record = stream.nextRecord());) {
    kinds[record.type] = (kinds[record.type] ?? 0) + 1;
    if (record.type === 'Schema') schemas.set(record.id, record);
    if (record.type === 'Channel') channels.set(record.id, record);
    if (record.type !== 'Message') continue;
    ++streamed;
    const channel = channels.get(record.channelId);
    assert.strictEqual(channel.messageEncoding, 'cdr');
    channel.schema ??= schemas.get(channel.schemaId);
    channel.reader ??= new MessageReader(parse(new TextDecoder().decode(channel.schema.data), {ros2: true}));
    const list = messages.get(channel.topic) ?? [];
    list.push({log: record.logTime, value: channel.reader.readMessage(record.data)});
    messages.set(channel.topic, list);
  }
  for (const schema of schemas.values()) {
    assert.strictEqual(schema.encoding, 'ros2msg');
    const foxglove = schema.name.match(/^foxglove_msgs\/msg\/(.*)$/);
    if (foxglove) compareSchema(foxglove[1], new TextDecoder().decode(schema.data));
  }

  // By the index: the same number of messages, in order of time, those of one topic alone.
  const readable = {size: async () => BigInt(bytes.length),
                    read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size)))};
  const indexed = await McapIndexedReader.Initialize({readable, decompressHandlers});
  assert.strictEqual(Number(indexed.statistics.messageCount), streamed);
  assert.strictEqual(indexed.header.profile, 'ros2');
  assert.notStrictEqual(indexed.dataSectionCrc, 0);
  assert.notStrictEqual(indexed.footer.summaryCrc, 0);
  assert(indexed.chunkIndexes.length > 0 && indexed.summaryOffsetsByOpcode.size > 0);
  let inOrder = 0, last = -1n;
  for await (const message of indexed.readMessages()) {
    assert(message.logTime >= last);
    last = message.logTime;
    ++inOrder;
  }
  assert.strictEqual(inOrder, streamed);
  let imus = 0;
  for await (const message of indexed.readMessages({topics: ['/imu']})) imus += message.data.length > 0 ? 1 : 0;

  const events = readLog(log);
  const of = type => events.filter(event => event.type === type);
  const at = topic => messages.get(topic) ?? [];
  const images = of('image_t').filter(e => e.channel === 'CAMERA');
  assert(images.length > 0);
  assert.strictEqual(at('/camera/image').length, images.length);
  images.forEach((image, i) => {
    const {log: time, value} = at('/camera/image')[i];
    assert.strictEqual(time, BigInt(image.utime) * 1000n);
    assert.strictEqual(utimeOf(value.timestamp), image.utime);
    if (image.format === MJPEG) assert.strictEqual(value.format, 'jpeg');
    else assert.deepStrictEqual([value.width, value.height, value.encoding, value.step], [image.width, image.height, 'mono8', image.stride]);
    assert(Buffer.from(value.data).equals(image.data), `image ${i}`);
    const info = at('/camera/camera_info')[i].value;
    assert.deepStrictEqual([info.width, info.height], [image.width, image.height]);
    assert(info.k[0] > 0 && info.k[0] === info.p[0]);
  });
  assert.strictEqual(at('/imu').length, of('ins_t').length);
  assert.strictEqual(imus, of('ins_t').length);
  of('ins_t').forEach((imu, i) => {
    const {value} = at('/imu')[i];
    assert.strictEqual(utimeOf(value.header.stamp), imu.utime);
    assert.deepStrictEqual([value.angular_velocity.x, value.angular_velocity.y, value.angular_velocity.z], imu.gyro);
    assert.deepStrictEqual([value.linear_acceleration.x, value.linear_acceleration.y, value.linear_acceleration.z], imu.accel);
    assert.strictEqual(value.orientation_covariance[0], -1);
  });
  of('altimeter_t').forEach((altitude, i) => {
    const {value} = at('/altimeter')[i];
    assert.strictEqual(value.range, Math.fround(altitude.height));
    assert(Math.abs(Math.sqrt(value.variance) - altitude.sigma) < 1e-6);
  });

  // One annotation a frame; its boxes are the table's.
  const rows = fs.readFileSync(csv, 'utf8').trim().split('\n').filter(line => /^\d/.test(line)).map(line => line.split(',').map(Number));
  let boxes = 0;
  assert.strictEqual(at('/detections').length, images.length);
  at('/detections').forEach(({value}, i) => {
    const wanted = rows.filter(row => row[10] === images[i].utime);
    assert.strictEqual(value.points.length, wanted.length);
    assert.strictEqual(value.texts.length, wanted.length);
    wanted.forEach(([, id, x, y, w, h, score], k) => {
      ++boxes;
      const {points, type, metadata} = value.points[k];
      assert.strictEqual(type, 2);
      assert.deepStrictEqual(points.map(p => [p.x, p.y]), [[x, y], [x + w, y], [x + w, y + h], [x, y + h]]);
      assert.deepStrictEqual(metadata.find(entry => entry.key === 'id').value, String(id));
      assert.strictEqual(value.texts[k].text.split(' ')[0], String(id));
      assert(Math.abs(Number(value.texts[k].text.split(' ')[1]) - score) < 0.006);
    });
  });
  assert.strictEqual(boxes, rows.length);
  const summary = [...messages].map(([topic, list]) => `${topic} ${list.length}`).join(', ');
  console.log(`${kinds.Chunk ?? indexed.chunkIndexes.length} chunks, ${streamed} messages, ${boxes} boxes: ${summary}`);
}
main().catch(error => { console.error(error); process.exit(1); });
