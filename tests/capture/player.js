// player.js LOG FRAMES SENT PORT_CAMERA PORT_AUTOPILOT ROUNDS: plays a recorded flight as its vehicle would send it, ROUNDS times with pauses between.
// A camera: GStreamer (gst-launch-1.0) sends the JPEG files FRAMES/NNN.jpg over RTP (RFC 2435) to a port of the loopback, each at its time.
// An autopilot by another implementation of MAVLink (node-mavlink, in NODE_PATH): IMU and height of the log, and answers to TIMESYNC, to the other port;
// its clock began 1000 s ago and runs fast by 20e-6. SENT gets a line for every image as it is sent:
//   round, number of the frame in the log, its time on this computer's clock [us]
// The rounds begin when the autopilot has been asked for its clock for two seconds.
const fs = require('fs')
const dgram = require('dgram')
const { spawn } = require('child_process')
const { MavLinkProtocolV2, MavLinkPacketSplitter, MavLinkPacketParser, minimal, common } = require('node-mavlink')

const [logFile, frames, sentFile, cameraPort, autopilotPort, rounds] = process.argv.slice(2)
const kPause_us = 2500000 // longer than what the filters bridge
const kSettle_us = 2000000

// Events of an LCM log; the messages' layouts are those of lcmtypes, behind their 8 bytes of hash.
function readLog(file) {
  const log = fs.readFileSync(file)
  const flight = { CAMERA: [], IMU: [], ALTIMETER: [] }
  for (let at = 0; at + 28 <= log.length;) {
    const name = log.readInt32BE(at + 20)
    const size = log.readInt32BE(at + 24)
    const channel = log.toString('latin1', at + 28, at + 28 + name)
    const data = log.subarray(at + 28 + name, at + 28 + name + size)
    at += 28 + name + size
    if (!flight[channel]) continue
    const doubles = (from, count) => Array.from({ length: count }, (_, i) => data.readDoubleBE(from + 8 * i))
    const event = { time: Number(data.readBigInt64BE(8)) }
    if (channel === 'IMU') Object.assign(event, { gyro: doubles(24, 3), accel: doubles(72, 3) })
    if (channel === 'ALTIMETER') event.height = data.readDoubleBE(16)
    if (channel === 'CAMERA') event.jpeg = fs.readFileSync(`${frames}/${String(flight.CAMERA.length).padStart(3, '0')}.jpg`)
    flight[channel].push(event)
  }
  return flight
}
const flight = readLog(logFile)
const first = Math.min(...Object.values(flight).map(events => events[0].time))
const last = Math.max(...Object.values(flight).map(events => events[events.length - 1].time))

const host_us = () => Number(process.hrtime.bigint() / 1000n) // CLOCK_MONOTONIC, as the stack's
const boot_us = host_us() - 1000e6
const device_us = time => Math.round((time - boot_us) * (1 + 20e-6))

const camera = spawn('gst-launch-1.0', ['-q', 'fdsrc', 'fd=0', 'do-timestamp=true', '!', 'multipartdemux', 'single-stream=true', '!',
  'capssetter', 'replace=true', 'caps=image/jpeg,width=640,height=480,framerate=24/1', '!', 'rtpjpegpay', '!',
  'udpsink', 'host=127.0.0.1', `port=${cameraPort}`, 'sync=false'], { stdio: ['pipe', 'inherit', 'inherit'] })
camera.on('exit', code => { if (code) process.exit(1) })
const sent = fs.openSync(sentFile, 'a')
function sendImage(round, k, image) {
  fs.writeSync(sent, `${round},${k},${image.at}\n`)
  camera.stdin.write(Buffer.concat([Buffer.from(`--frame\r\nContent-Type: image/jpeg\r\nContent-Length: ${image.jpeg.length}\r\n\r\n`), image.jpeg, Buffer.from('\r\n')]))
}

const protocol = new MavLinkProtocolV2(1, 1)
const socket = dgram.createSocket('udp4')
let sequence = 0
let asked_us = null
const send = (type, fields) => {
  socket.send(protocol.serialize(Object.assign(new type(), fields), sequence), Number(autopilotPort), '127.0.0.1')
  sequence = (sequence + 1) % 256
}
const splitter = new MavLinkPacketSplitter()
socket.on('error', () => {})
socket.on('message', bytes => splitter.write(bytes))
splitter.pipe(new MavLinkPacketParser()).on('data', packet => {
  if (packet.header.msgid !== common.TimeSync.MSG_ID) return
  const request = packet.protocol.data(packet.payload, common.TimeSync)
  if (request.tc1 !== 0n) return
  asked_us ??= host_us()
  send(common.TimeSync, { tc1: BigInt(device_us(host_us())) * 1000n, ts1: request.ts1, targetSystem: packet.header.sysid,
    targetComponent: packet.header.compid })
})

// MAVLink's body axes are forward, right, down; the log's forward, left, up.
const sendImu = ({ at, gyro, accel }) => send(common.HighresImu, { timeUsec: BigInt(device_us(at)), xacc: accel[0], yacc: -accel[1], zacc: -accel[2],
  xgyro: gyro[0], ygyro: -gyro[1], zgyro: -gyro[2], xmag: 0, ymag: 0, zmag: 0, absPressure: 1000, diffPressure: 0, pressureAlt: 0, temperature: 20,
  fieldsUpdated: 0x3f, id: 0 })
// The log's height is along the vertical: as a level vehicle measures it.
function sendHeight({ at, height }) {
  const timeBootMs = Math.round(device_us(at) / 1000)
  send(common.AttitudeQuaternion, { timeBootMs, q1: 1, q2: 0, q3: 0, q4: 0, rollspeed: 0, pitchspeed: 0, yawspeed: 0, reprOffsetQ: [0, 0, 0, 0] })
  send(common.DistanceSensor, { timeBootMs, minDistance: 20, maxDistance: 10000, currentDistance: Math.round(100 * height), type: 0, id: 0, orientation: 25,
    covariance: 255, horizontalFov: 0, verticalFov: 0, quaternion: [0, 0, 0, 0], signalQuality: 0 })
}

let round = 0
let begin_us = null
let next = { CAMERA: 0, IMU: 0, ALTIMETER: 0 }
let heartbeat_us = 0
const timer = setInterval(() => {
  const now = host_us()
  if (now >= heartbeat_us) {
    heartbeat_us = now + 1e6
    send(minimal.Heartbeat, { customMode: 0, type: 2, autopilot: 12, baseMode: 81, systemStatus: 4, mavlinkVersion: 3 })
  }
  if (begin_us === null && asked_us !== null && now > asked_us + kSettle_us) begin_us = now + 100000
  if (begin_us === null) return
  const play = (channel, sender) => {
    const events = flight[channel]
    for (; next[channel] < events.length && begin_us + events[next[channel]].time - first <= now; ++next[channel]) {
      const event = events[next[channel]]
      sender({ ...event, at: begin_us + event.time - first })
    }
  }
  play('IMU', sendImu)
  play('ALTIMETER', sendHeight)
  play('CAMERA', image => sendImage(round, next.CAMERA, image))
  if (now < begin_us + last - first + kPause_us) return
  begin_us = now
  next = { CAMERA: 0, IMU: 0, ALTIMETER: 0 }
  if (++round < Number(rounds)) return
  clearInterval(timer)
  camera.stdin.end()
  setTimeout(() => process.exit(0), 500)
}, 1)
