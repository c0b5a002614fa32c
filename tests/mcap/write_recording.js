// write_recording.js OUT COMPRESSION (none, zstd, lz4): a recording as rosbag2 makes it, written by Foxglove's implementation, with what
// check_import.js expects. COMPRESSION json: one that holds no ROS messages.
const {execFileSync} = require('child_process');
const fs = require('fs');
const {McapWriter} = require('@mcap/core');
const {parse} = require('@foxglove/rosmsg');
const {MessageWriter} = require('@foxglove/rosmsg2-serialization');
const zstd = require('@foxglove/wasm-zstd');
const {frameOf, imuOf, FRAMES, FPS, IMU_RATE, WIDTH, HEIGHT, timeOf} = require('./recording.js');

const [out, compression] = process.argv.slice(2);
const separator = '='.repeat(80);
const header = `${separator}\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n`;
const vector = `${separator}\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n`;
const definitions = {
  'sensor_msgs/msg/Image': `std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\nuint8[] data\n${header}`,
  'sensor_msgs/msg/Imu': `std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance\n` +
    `geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\ngeometry_msgs/Vector3 linear_acceleration\n` +
    `float64[9] linear_acceleration_covariance\n${header}${separator}\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n${vector}`,
  'sensor_msgs/msg/Range': `std_msgs/Header header\nuint8 radiation_type\nfloat32 field_of_view\nfloat32 min_range\nfloat32 max_range\nfloat32 range\n${header}`,
  'sensor_msgs/msg/CameraInfo': `std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] d\nfloat64[9] k\n` +
    `float64[9] r\nfloat64[12] p\nuint32 binning_x\nuint32 binning_y\nsensor_msgs/RegionOfInterest roi\n${header}${separator}\n` +
    `MSG: sensor_msgs/RegionOfInterest\nuint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n`,
};

async function main() {
  await zstd.isLoaded;
  // Debian's lz4: Foxglove's only decompresses.
  const compress = {zstd: data => zstd.compress(data, 3), lz4: data => execFileSync('lz4', ['-c'], {input: data})}[compression];
  const parts = [];
  let size = 0n;
  const writable = {position: () => size, write: async bytes => { parts.push(Buffer.from(bytes)); size += BigInt(bytes.length); }};
  const writer = new McapWriter({writable, chunkSize: 20000,
                                 compressChunk: compress && (data => ({compression, compressedData: new Uint8Array(compress(data))}))});
  await writer.start({profile: 'ros2', library: 'redbee test'});
  const channel = async (topic, name) => {
    const data = new TextEncoder().encode(definitions[name] ?? '{}');
    const isJson = compression === 'json';
    const schemaId = await writer.registerSchema({name, encoding: isJson ? 'jsonschema' : 'ros2msg', data});
    const id = await writer.registerChannel({topic, schemaId, messageEncoding: isJson ? 'json' : 'cdr', metadata: new Map()});
    const serialiser = isJson ? undefined : new MessageWriter(parse(definitions[name], {ros2: true}));
    return async (time, message) => writer.addMessage({
      channelId: id, sequence: 0, logTime: time + 3000000n, publishTime: time,
      data: isJson ? new TextEncoder().encode('{}') : serialiser.writeMessage(message)});
  };
  const stamp = time => ({sec: Number(time / 1000000000n), nanosec: Number(time % 1000000000n)});
  const head = time => ({stamp: stamp(time), frame_id: 'camera'});
  const image = await channel('/cam0/image_raw', 'sensor_msgs/msg/Image');
  const info = await channel('/cam0/camera_info', 'sensor_msgs/msg/CameraInfo');
  const imu = await channel('/imu0', 'sensor_msgs/msg/Imu');
  const range = await channel('/altimeter', 'sensor_msgs/msg/Range');
  const events = [];
  for (let k = 0; k < FRAMES; ++k) events.push([timeOf(k / FPS), 'frame', k]);
  for (let k = 0; k < FRAMES * IMU_RATE / FPS; ++k) events.push([timeOf(k / IMU_RATE), 'imu', k]);
  events.sort((a, b) => (a[0] < b[0] ? -1 : a[0] > b[0] ? 1 : 0));
  for (const [time, kind, k] of events) {
    if (kind === 'frame') {
      await image(time, {header: head(time), height: HEIGHT, width: WIDTH, encoding: 'mono8', is_bigendian: 0, step: WIDTH, data: frameOf(k)});
      await info(time, {header: head(time), height: HEIGHT, width: WIDTH, distortion_model: 'equidistant', d: [0.1, -0.02, 0.003, 0.0004],
                        k: [30, 0, 15.5, 0, 31, 11.5, 0, 0, 1], r: new Array(9).fill(0), p: new Array(12).fill(0), binning_x: 0, binning_y: 0,
                        roi: {x_offset: 0, y_offset: 0, height: 0, width: 0, do_rectify: false}});
      await range(time, {header: head(time), radiation_type: 1, field_of_view: 0, min_range: 0.1, max_range: 50, range: 5 + k / 8});
    } else {
      const {gyro, accel} = imuOf(k);
      const xyz = v => ({x: v[0], y: v[1], z: v[2]});
      await imu(time, {header: head(time), orientation: {x: 0, y: 0, z: 0, w: 1}, orientation_covariance: new Array(9).fill(0),
                       angular_velocity: xyz(gyro), angular_velocity_covariance: new Array(9).fill(0),
                       linear_acceleration: xyz(accel), linear_acceleration_covariance: new Array(9).fill(0)});
    }
  }
  await writer.end();
  fs.writeFileSync(out, Buffer.concat(parts));
}
main().catch(error => { console.error(error); process.exit(1); });
