// player.js TRUTH [OPTION=VALUE...]: an autopilot by another implementation of MAVLink (node-mavlink, in NODE_PATH). It answers TIMESYNC and
// SET_MESSAGE_INTERVAL, sends what it is asked for, damages what it is told to, and appends to TRUTH every sample of the IMU:
//   number, its time on the device's clock [us], then on this computer's [us], 1 if it left undamaged
// Options:
//   udp=PORT      speaks to this port of the loopback; otherwise over stdin and stdout
//   samples=N     then it ends (1500)
//   damage=P      fraction of the frames that lose a byte, have a wrong one, or are followed by noise (0)
//   drop=P        fraction of the frames that are not sent (0)
//   reboot=N      after so many samples it starts again: silent for half a second, its clock and settings begin anew
//   key=HEX       signs, and sends unsigned and repeated frames among them, with a rotation rate of 9 rad/s
//   up=S          since when it is up [s] (1000)
//   drift=X       s/s, of its clock (0)
const fs = require('fs')
const dgram = require('dgram')
const { MavLinkProtocolV1, MavLinkProtocolV2, MavLinkPacketSplitter, MavLinkPacketParser, minimal, common } = require('node-mavlink')

const [truthFile, ...rest] = process.argv.slice(2)
const options = Object.fromEntries(rest.map(each => each.split('=')))
const number = (name, otherwise) => Number(options[name] ?? otherwise)
const samples = number('samples', 1500)
const key = options.key ? Buffer.from(options.key, 'hex') : null
const v1 = new MavLinkProtocolV1(1, 1)
const v2 = new MavLinkProtocolV2(1, 1, key ? MavLinkProtocolV2.IFLAG_SIGNED : 0)
const plain = new MavLinkProtocolV2(1, 1)

// Always the same sequence (Lehmer).
let state = 12345
const random = () => (state = (state * 48271) % 2147483647) / 2147483647

const start = process.hrtime.bigint()
let boot = start - BigInt(number('up', 1000)) * 1000000000n
const host = () => process.hrtime.bigint() // CLOCK_MONOTONIC
const device = now => now - boot + BigInt(Math.round(Number(now - boot) * number('drift', 0)))

let output
if (options.udp) {
  const socket = dgram.createSocket('udp4')
  output = bytes => socket.send(bytes, Number(options.udp), '127.0.0.1')
  socket.on('error', () => {})
  socket.on('message', bytes => splitter.write(bytes))
} else {
  output = bytes => process.stdout.write(bytes)
  process.stdin.on('data', bytes => splitter.write(bytes))
}

let sequence = 0
let stamp = 0
const signed = frame => {
  const epoch = MavLinkProtocolV2.SIGNATURE_START_TIME
  stamp = Math.max(stamp + 1, Math.floor((Date.now() - epoch) * 100))
  return v2.sign(frame, 1, key, epoch + (stamp + 0.5) / 100)
}

// Whether it left undamaged.
function send(type, fields, protocol = v2) {
  const message = Object.assign(new type(), fields)
  let frame = protocol.serialize(message, sequence)
  sequence = (sequence + 1) % 256
  if (protocol === v2 && key) frame = signed(frame)
  if (random() < number('drop', 0)) return false
  if (random() >= number('damage', 0)) {
    output(frame)
    return true
  }
  const at = Math.floor(random() * frame.length)
  const kind = Math.floor(random() * 3)
  if (kind === 0) output(Buffer.concat([frame.slice(0, at), frame.slice(at + 1)]))
  if (kind === 1) {
    frame[at] ^= 1 + Math.floor(random() * 255)
    output(frame)
  }
  if (kind === 2) output(Buffer.concat([frame, Buffer.from(Array.from({ length: 30 }, () => Math.floor(random() * 256)))]))
  return kind === 2
}

let intervals = {}
let silentUntil = 0n
const splitter = new MavLinkPacketSplitter()
splitter.pipe(new MavLinkPacketParser()).on('data', packet => {
  if (host() < silentUntil) return
  if (packet.header.msgid === common.TimeSync.MSG_ID) {
    const request = packet.protocol.data(packet.payload, common.TimeSync)
    if (request.tc1 !== 0n) return
    send(common.TimeSync, { tc1: device(host()), ts1: request.ts1, targetSystem: packet.header.sysid, targetComponent: packet.header.compid })
  } else if (packet.header.msgid === common.CommandLong.MSG_ID) {
    const command = packet.protocol.data(packet.payload, common.CommandLong)
    if (command.command === 511) intervals[command._param1] = { every: command._param2 / 1e6, next: 0 }
  }
})

const truth = []
function sendImu() {
  const now = host()
  const time = device(now) / 1000n
  const n = truth.length
  const fields = { timeUsec: time, xacc: Math.sin(n / 7), yacc: 0.5, zacc: -9.81, xgyro: Math.cos(n / 5), ygyro: -0.25, zgyro: 0.125,
    xmag: 0.25, ymag: 0, zmag: 0.5, absPressure: 1000, diffPressure: 0, pressureAlt: 100, temperature: 20, fieldsUpdated: 0xffff, id: 0 }
  const undamaged = send(common.HighresImu, fields)
  truth.push(`${n},${time},${(now + 500n) / 1000n},${undamaged ? 1 : 0}`)
  if (key && n % 10 === 0) {
    output(plain.serialize(Object.assign(new common.HighresImu(), fields, { timeUsec: time + 1000n, xgyro: 9 }), sequence))
    const forged = v2.sign(v2.serialize(Object.assign(new common.HighresImu(), fields, { timeUsec: time + 2000n, xgyro: 9 }), sequence), 1, key,
      MavLinkProtocolV2.SIGNATURE_START_TIME + (stamp - 1000.5) / 100)
    output(forged)
  }
  if (n + 1 === number('reboot', -1)) {
    boot = now + 400000000n
    silentUntil = now + 500000000n
    sequence = 0
    intervals = {}
  }
  if (truth.length >= samples) {
    fs.appendFileSync(truthFile, truth.join('\n') + '\n')
    setTimeout(() => process.exit(0), 1000)
    clearInterval(timer)
  }
}

const senders = {
  105: sendImu,
  31: ms => send(common.AttitudeQuaternion, { timeBootMs: ms, q1: Math.SQRT1_2, q2: 0, q3: 0, q4: Math.SQRT1_2, rollspeed: 0, pitchspeed: 0,
    yawspeed: 0, reprOffsetQ: [0, 0, 0, 0] }),
  33: ms => send(common.GlobalPositionInt, { timeBootMs: ms, lat: 473000000, lon: 85000000, alt: 510000, relativeAlt: 10000, vx: 0, vy: 0, vz: 0, hdg: 9000 }),
  24: ms => send(common.GpsRawInt, { timeUsec: BigInt(ms) * 1000n, fixType: 3, lat: 473000000, lon: 85000000, alt: 510000, eph: 80, epv: 120, vel: 0, cog: 0,
    satellitesVisible: 12, altEllipsoid: 557000, hAcc: 1500, vAcc: 2500, velAcc: 300, hdgAcc: 0, yaw: 0 }),
  132: ms => send(common.DistanceSensor, { timeBootMs: ms, minDistance: 20, maxDistance: 5000, currentDistance: 1234, type: 0, id: 0, orientation: 25,
    covariance: 4, horizontalFov: 0, verticalFov: 0, quaternion: [0, 0, 0, 0], signalQuality: 0 }),
  271: ms => send(common.CameraFovStatus, { timeBootMs: ms, latCamera: 473000000, lonCamera: 85000000, altCamera: 510000, latImage: 0, lonImage: 0,
    altImage: 0, q: [1, 0, 0, 0], hfov: 60, vfov: 36, cameraDeviceId: 0 }),
}
const seconds = () => Number(host() - start) * 1e-9
let heartbeat = 0
const timer = setInterval(() => {
  if (host() < silentUntil) return
  const now = seconds()
  if (now >= heartbeat) {
    heartbeat = now + 1
    // Half of them in MAVLink 1.
    const isOld = !key && Math.floor(now) % 2 === 1
    send(minimal.Heartbeat, { customMode: 0, type: 2, autopilot: 12, baseMode: 81, systemStatus: 4, mavlinkVersion: 3 }, isOld ? v1 : v2)
  }
  for (const [id, interval] of Object.entries(intervals)) {
    if (now < interval.next || !senders[id] || host() < silentUntil) continue
    interval.next = Math.max(interval.next + interval.every, now - interval.every)
    senders[id](Number(device(host()) / 1000000n))
  }
}, 1)
