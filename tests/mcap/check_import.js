// check_import.js LOG: the log that `redbee import mcap` made of write_recording.js' file holds what was written.
const assert = require('assert');
const {readLog, GRAY} = require('./lcm_log.js');
const {frameOf, imuOf, timeOf, FRAMES, FPS, IMU_RATE, WIDTH, HEIGHT} = require('./recording.js');

const events = readLog(process.argv[2]);
const of = type => events.filter(event => event.type === type);
const utimeOf = seconds => Number(timeOf(seconds) / 1000n);
assert.strictEqual(of('image_t').length, FRAMES);
of('image_t').forEach((image, k) => {
  assert.deepStrictEqual([image.utime, image.width, image.height, image.format], [utimeOf(k / FPS), WIDTH, HEIGHT, GRAY]);
  assert(image.data.equals(Buffer.from(frameOf(k))), `image ${k}`);
});
assert.strictEqual(of('ins_t').length, FRAMES * IMU_RATE / FPS);
of('ins_t').forEach((imu, k) => {
  assert.strictEqual(imu.utime, utimeOf(k / IMU_RATE));
  assert.deepStrictEqual({gyro: imu.gyro, accel: imu.accel}, imuOf(k));
});
assert.deepStrictEqual(of('altimeter_t').map(a => a.height), Array.from({length: FRAMES}, (_, k) => 5 + k / 8));
console.log(`${events.length} messages as written`);
