// What write_recording.js writes and check_import.js expects.
const FRAMES = 20, FPS = 20, IMU_RATE = 200, WIDTH = 32, HEIGHT = 24;
const START = 1600000000000000000n;
exports.timeOf = seconds => START + BigInt(Math.round(seconds * 1e9));
exports.frameOf = k => Uint8Array.from({length: WIDTH * HEIGHT}, (_, i) => (7 * k + 3 * (i % WIDTH) + 2 * Math.floor(i / WIDTH)) % 256);
exports.imuOf = k => ({gyro: [0.01 * Math.sin(0.1 * k), 0.002 * (k % 5), -0.001 * (k % 7)], accel: [0.01 * (k % 3), 0.02 * (k % 4), 9.81 + 0.01 * (k % 2)]});
Object.assign(exports, {FRAMES, FPS, IMU_RATE, WIDTH, HEIGHT});
