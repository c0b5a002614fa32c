// ground_station.js FLIGHT [OPTION=VALUE...]: a ground station by another implementation of MAVLink (node-mavlink, in NODE_PATH) that looks at
// redbee-ground-link, picks the walker and checks what it is told. FLIGHT: what target_trial prints. Ends with status 1 where anything is wrong.
// Options:
//   udp=PORT      of the loopback, where it listens (14550)
//   key=HEX       commands are signed, after an unsigned one that must not be obeyed
const fs = require('fs')
const dgram = require('dgram')
const { MavLinkProtocolV2, MavLinkPacketSplitter, MavLinkPacketParser, minimal, common } = require('node-mavlink')

const [flightFile, ...rest] = process.argv.slice(2)
const options = Object.fromEntries(rest.map(each => each.split('=')))
const key = options.key ? Buffer.from(options.key, 'hex') : null
const protocol = new MavLinkProtocolV2(255, 190, key ? MavLinkProtocolV2.IFLAG_SIGNED : 0)
const plain = new MavLinkProtocolV2(255, 190)
let faults = 0
const expect = (holds, what) => {
  if (holds) return
  console.log('FAILED: ' + what)
  ++faults
}

let peer = null
const socket = dgram.createSocket('udp4')
const splitter = new MavLinkPacketSplitter()
socket.on('message', (bytes, from) => {
  peer = from
  splitter.write(bytes)
})
socket.bind(Number(options.udp ?? 14550), '127.0.0.1')

const registry = { ...minimal.REGISTRY, ...common.REGISTRY }
const received = [] // { type, message, isSigned }
splitter.pipe(new MavLinkPacketParser()).on('data', packet => {
  const type = registry[packet.header.msgid]
  if (packet.header.sysid !== 1 || packet.header.compid !== 100 || !type) return
  const isSigned = Boolean(packet.signature) && (!key || packet.signature.matches(key))
  received.push({ type, message: packet.protocol.data(packet.payload, type), isSigned, time: Date.now() })
})

let sequence = 0
const command = (id, params = [], isSigned = true) => {
  const message = Object.assign(new common.CommandLong(), { command: id, targetSystem: 1, targetComponent: 100, confirmation: 0 })
  for (let i = 1; i <= 7; ++i) message[`_param${i}`] = params[i - 1] ?? 0
  const by = isSigned && key ? protocol : plain
  let frame = by.serialize(message, sequence++ % 256)
  if (isSigned && key) frame = protocol.sign(frame, 1, key, Date.now())
  socket.send(frame, peer.port, peer.address)
}
const pause = ms => new Promise(done => setTimeout(done, ms))
const of = (type, since) => received.slice(since).filter(each => each.type === type).map(each => each.message)
// The next of a type that fulfils a condition; what has come before counts, too, from `since`.
async function next(type, what, condition = () => true, since = received.length) {
  for (let waited = 0; waited < 30000; waited += 20) {
    const found = of(type, since).find(condition)
    if (found) return found
    await pause(20)
  }
  expect(false, what + ' does not come')
  process.exit(1)
}
async function answered(id, params, isSigned) {
  const since = received.length
  command(id, params, isSigned)
  return (await next(common.CommandAck, `an answer to command ${id}`, ack => ack.command === id, since)).result
}
const near = (a, b, tolerance) => Math.abs(a - b) <= tolerance
const ACTIVE = 1, MTI = 4, COASTING = 8
const Image = common.CameraTrackingImageStatus, Geo = common.CameraTrackingGeoStatus

async function main() {
  const heartbeat = await next(minimal.Heartbeat, 'a heartbeat', () => true, 0)
  expect(heartbeat.type === 30 && heartbeat.autopilot === 8, 'the heartbeat is no camera\'s')

  expect(await answered(512, [259]) === 0, 'CAMERA_INFORMATION is refused')
  const information = await next(common.CameraInformation, 'CAMERA_INFORMATION', () => true, 0)
  expect(information.flags === (512 | 1024 | 2048 | 8192), `capabilities ${information.flags}`)
  expect(information.resolutionH === 640 && information.resolutionV === 480, 'resolution')

  // Nobody is picked: the walker is indicated.
  const mover = await next(Image, 'a moving target indicator', each => each.trackingStatus === MTI)
  expect(mover.trackingMode === 2 && mover.targetData === 4, 'an indicator without a rectangle')
  expect(near(mover.recBottomX - mover.recTopX, 12 / 640, 1e-6) && near(mover.recBottomY - mover.recTopY, 16 / 480, 1e-6), 'the box\'s size')

  if (key) {
    command(2004, [mover.pointX, mover.pointY, 0], false)
    await pause(1000)
    expect(of(Image, received.length - 5).every(each => each.trackingStatus === MTI), 'an unsigned command was obeyed')
    expect(received.every(each => each.isSigned), 'frames without a right signature')
  }
  expect(await answered(2004, [0.01, 0.99, 0]) === 4, 'a point without an object is not refused')
  expect(await answered(2004, [mover.pointX, mover.pointY, 0.02]) === 0, 'the walker cannot be picked')
  const picked = await next(Image, 'an active status', each => each.trackingStatus === (ACTIVE | MTI))
  expect(picked.trackingMode === 1 && near(picked.radius, 6 / 640, 1e-6), 'the picked point')
  const since = received.length
  await pause(2000)
  const geo = of(Geo, since)
  expect(geo.length >= 6, `${geo.length} places in two seconds`)
  // Each place is one that TARGETS said; target_trial has compared those with the truth.
  const said = fs.readFileSync(flightFile, 'utf8').split('\n').map(line => line.split(',')).filter(line => line[0] === 'TARGET')
  for (const each of geo) {
    const matches = said.filter(line => near(each.lat, line[5] * 1e7, 1) && near(each.lon, line[6] * 1e7, 1))
    expect(matches.length > 0, `a place ${each.lat} ${each.lon} that TARGETS did not say`)
    expect(matches.every(line => Number(line[7]) < 1), 'the place is off')
    expect(each.trackingStatus === (ACTIVE | MTI), `status ${each.trackingStatus}`)
    expect(near(each.velE, 3.5, 0.5) && near(each.velN, 0, 0.5) && each.velD === 0, `velocity ${each.velE} ${each.velN}`)
    expect(near(each.hdg, Math.PI / 2, 0.3) && near(each.alt, 500, 0.01) && near(each.dist, 58, 2), `course ${each.hdg}, altitude ${each.alt}, distance ${each.dist}`)
    expect(each.hAcc > 0.5 && each.hAcc < 5, `accuracy ${each.hAcc}`)
  }
  expect(await answered(2010) === 0, 'the tracking cannot be stopped')
  await next(Image, 'an indicator again', each => each.trackingStatus === MTI)
  const now = of(Image, 0).pop()
  expect(await answered(2005, [now.recTopX - 0.02, now.recTopY - 0.02, now.recBottomX + 0.02, now.recBottomY + 0.02]) === 0, 'a rectangle picks nobody')
  await next(Image, 'an active rectangle', each => each.trackingStatus === (ACTIVE | MTI) && each.trackingMode === 2)
  expect(await answered(511, [276, -1]) === 0, 'the places cannot be turned off')
  const quiet = received.length
  await pause(1000)
  expect(of(Geo, quiet).length === 0, 'places that were turned off come')
  expect(await answered(511, [276, 100000]) === 0, 'the places cannot be turned on')
  expect(await answered(2000) === 3, 'a command that is not known is not refused')

  // The walker stops.
  const coasting = await next(Geo, 'a coasting status', each => each.trackingStatus === (ACTIVE | MTI | COASTING))
  expect(near(coasting.velD, 0, 0), 'a coasting velocity')
  console.log(`${received.length} messages, ${of(Image, 0).length} of boxes, ${of(Geo, 0).length} of places`)
  process.exit(faults > 0 ? 1 : 0)
}
main()
