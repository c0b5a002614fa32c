// check_stack.js MCAP: the export of stack_log.cpp's log: health as numbers, its changes as log messages, boxes, masks.
const assert = require('assert');
const fs = require('fs');
const {McapStreamReader} = require('@mcap/core');
const {loadDecompressHandlers} = require('@mcap/support');
const {parse} = require('@foxglove/rosmsg');
const {MessageReader} = require('@foxglove/rosmsg2-serialization');

async function main() {
  const stream = new McapStreamReader({decompressHandlers: await loadDecompressHandlers(), validateCrcs: true});
  stream.append(fs.readFileSync(process.argv[2]));
  const schemas = new Map(), channels = new Map(), messages = {};
  for (let record; (record = stream.nextRecord());) {
    if (record.type === 'Schema') schemas.set(record.id, record);
    if (record.type === 'Channel') channels.set(record.id, record);
    if (record.type !== 'Message') continue;
    const channel = channels.get(record.channelId);
    const reader = new MessageReader(parse(new TextDecoder().decode(schemas.get(channel.schemaId).data), {ros2: true}));
    (messages[channel.topic] ??= []).push(reader.readMessage(record.data));
  }
  const health = messages['/process_health/homography_fusion'];
  assert.deepStrictEqual(health.map(h => h.latency_p99), Array.from({length: 10}, (_, k) => 2.5 * k));
  assert.deepStrictEqual(health.map(h => h.resident), Array.from({length: 10}, (_, k) => 3000000000n + BigInt(k)));
  assert.deepStrictEqual(health.map(h => h.received), Array.from({length: 10}, (_, k) => 100n * BigInt(k)));
  assert.deepStrictEqual(health.map(h => h.state), [1, 1, 1, 1, 1, 1, 2, 2, 2, 2]);
  const log = messages['/log'];
  assert.deepStrictEqual(log.map(l => [l.timestamp.sec, l.level, l.name, l.message]),
                         [[1600000000, 2, 'homography-fusion', ''], [1600000006, 3, 'homography-fusion', 'IMU and camera disagree']]);
  const boxes = messages['/detections'];
  assert.deepStrictEqual(boxes.map(b => b.points.length), [0, 1, 1, 1, 1, 1, 1, 1, 1, 1]);
  assert.deepStrictEqual(boxes[4].points[0].points, [{x: 12, y: 5}, {x: 32, y: 5}, {x: 32, y: 15}, {x: 12, y: 15}]);
  assert.strictEqual(boxes[4].texts[0].text, '44 0.50');
  assert.notDeepStrictEqual(boxes[4].points[0].outline_color, boxes[5].points[0].outline_color);  // seen, predicted
  for (const topic of ['/foreground/mask', '/foreground/probability']) {
    assert.strictEqual(messages[topic].length, 7);  // not while it learns
    assert.strictEqual(messages[topic][0].format, 'png');
    assert.strictEqual(Buffer.from(messages[topic][0].data).toString('latin1', 1, 4), 'PNG');
  }
  console.log('health, log, boxes and masks as published');
}
main().catch(error => { console.error(error); process.exit(1); });
