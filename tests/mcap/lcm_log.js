// LCM logs, read without our code: {channel, ...} of image_t, ins_t and altimeter_t; others as {channel, type: hash}.
const fs = require('fs');

function messageOf(data) {
  const hash = data.readBigUInt64BE(0).toString(16);
  const utime = () => Number(data.readBigInt64BE(8));
  const doubles = (at, count) => Array.from({length: count}, (_, i) => data.readDoubleBE(at + 8 * i));
  switch (hash) {
    case '14739ffe13d5f5f0': {
      const [width, height, stride, format, size] = [0, 1, 2, 3, 4].map(i => data.readInt32BE(16 + 4 * i));
      return {type: 'image_t', utime: utime(), width, height, stride, format, data: data.subarray(36, 36 + size)};
    }
    case '88a7df61422b0840':
      return {type: 'ins_t', utime: utime(), gyro: doubles(24, 3), accel: doubles(72, 3)};
    default:
      if (data.length === 32) return {type: 'altimeter_t', utime: utime(), height: doubles(16, 1)[0], sigma: doubles(24, 1)[0]};
      return {type: hash};
  }
}

exports.readLog = file => {
  const bytes = fs.readFileSync(file);
  const events = [];
  for (let at = 0; at < bytes.length;) {
    if (bytes.readUInt32BE(at) !== 0xEDA1DA01) throw new Error(`${file}: byte ${at} begins no event`);
    const channelSize = bytes.readInt32BE(at + 20), size = bytes.readInt32BE(at + 24);
    const channel = bytes.toString('utf8', at + 28, at + 28 + channelSize);
    const start = at + 28 + channelSize;
    events.push({channel, ...messageOf(bytes.subarray(start, start + size))});
    at = start + size;
  }
  return events;
};
exports.MJPEG = 1196444237;
exports.GRAY = 1497715271;
