"""convert_log.py LOG BAG: CAMERA, IMU and ALTIMETER of an LCM log as a bag, written by ROS's own library; the log is read without our code.
convert_log.py --compare LOG OTHER: the same images and IMU samples in both logs, byte for byte, and altitudes to a float's precision."""
import struct
import sys

TYPES = {'14739ffe13d5f5f0': 'image', '88a7df61422b0840': 'imu'}


def read(path):
    data, at, events = open(path, 'rb').read(), 0, []
    while at < len(data):
        magic, _, _, channel, size = struct.unpack_from('>IqqII', data, at)
        assert magic == 0xEDA1DA01, at
        at += 28
        name, body = data[at:at + channel].decode(), data[at + channel:at + channel + size]
        events.append((name, body))
        at += channel + size
    return events


def of(events, channel):
    return [body for name, body in events if name == channel]


def write(log, out):
    import rosbag
    import rospy
    from sensor_msgs.msg import CompressedImage, Image, Imu, Range
    encodings = {1497715271: 'mono8', 859981650: 'rgb8', 861030210: 'bgr8'}
    with rosbag.Bag(out, 'w', compression='lz4') as bag:
        for channel, body in read(log):
            utime, = struct.unpack_from('>q', body, 8)
            stamp = rospy.Time(utime // 1000000, utime % 1000000 * 1000)
            if channel == 'CAMERA':
                width, height, stride, pixels, size = struct.unpack_from('>iiiii', body, 16)
                image = body[36:36 + size]
                if pixels in encodings:
                    message = Image(width=width, height=height, step=stride, encoding=encodings[pixels], data=image)
                    topic = '/camera/image_raw'
                else:
                    message, topic = CompressedImage(format='jpeg', data=image), '/camera/image_raw/compressed'
            elif channel == 'IMU':
                message, topic = Imu(), '/imu'
                values = struct.unpack_from('>9d', body, 24)
                message.angular_velocity.x, message.angular_velocity.y, message.angular_velocity.z = values[:3]
                message.linear_acceleration.x, message.linear_acceleration.y, message.linear_acceleration.z = values[6:9]
            elif channel == 'ALTIMETER':
                message, topic = Range(range=struct.unpack_from('>d', body, 16)[0]), '/altimeter'
            else:
                continue
            message.header.stamp = stamp
            bag.write(topic, message, stamp)


def compare(log, other):
    a, b = read(log), read(other)
    assert of(a, 'CAMERA') and of(a, 'CAMERA') == of(b, 'CAMERA'), 'images'
    imu = [[struct.unpack_from('>q', m, 8) + struct.unpack_from('>3d', m, 24) + struct.unpack_from('>3d', m, 72) for m in of(x, 'IMU')] for x in (a, b)]
    assert imu[0] and imu[0] == imu[1], 'IMU'
    heights = [[struct.unpack_from('>qd', m, 8) for m in of(x, 'ALTIMETER')] for x in (a, b)]
    assert len(heights[0]) == len(heights[1])
    assert all(s[0] == t[0] and abs(s[1] - t[1]) <= 1e-6 * abs(s[1]) for s, t in zip(*heights)), 'altitudes'
    print(f'{len(of(a, "CAMERA"))} images, {len(imu[0])} IMU samples, {len(heights[0])} altitudes are the same')


if sys.argv[1] == '--compare':
    compare(*sys.argv[2:])
else:
    write(*sys.argv[1:])
