"""make_bag.py OUT KIND [COMPRESSION [JPEG]]: writes a bag with ROS's own library, for rosbag_test.cpp, which knows what is in it."""
import math
import sys

import rosbag
import rospy
from sensor_msgs.msg import CameraInfo, CompressedImage, Image, Imu, Range

out, kind = sys.argv[1:3]
compression = sys.argv[3] if len(sys.argv) > 3 else 'none'
WIDTH, HEIGHT, FRAMES, FPS, IMU_RATE, START = 32, 24, 20, 20, 200, 1500000000


def at(seconds):
    return rospy.Time.from_sec(0) + rospy.Duration(START) + rospy.Duration(nsecs=round(seconds * 1e9))


def image(k, encoding='mono8', channels=1, bits=8):
    message = Image(width=WIDTH, height=HEIGHT, encoding=encoding, step=WIDTH * channels * bits // 8)
    message.header.stamp = at(k / FPS)
    if bits == 16:  # a ramp within a part of the range, its level moving with k
        values = [1000 + 10 * x + 100 * k for _ in range(HEIGHT) for x in range(WIDTH)]
        message.data = b''.join(v.to_bytes(2, 'big' if kind == 'mono16_big' else 'little') for v in values)
        message.is_bigendian = kind == 'mono16_big'
    else:
        message.data = bytes((k + x + 2 * y + 40 * c) % 256 for y in range(HEIGHT) for x in range(WIDTH) for c in range(channels))
    return message


def imu(k):
    message = Imu()
    message.header.stamp = at(k / IMU_RATE - 0.02)
    message.angular_velocity.x = 0.01 * math.sin(0.1 * k)
    message.angular_velocity.y = 0.002 * (k % 5)
    message.angular_velocity.z = -0.001 * (k % 7)
    scale = 1 / 9.80665 if kind == 'imu_in_g' else 1
    message.linear_acceleration.x = 0.01 * (k % 3) * scale
    message.linear_acceleration.y = 0.02 * (k % 4) * scale
    message.linear_acceleration.z = (9.81 + 0.01 * (k % 2)) * scale
    if kind == 'imu_without_gyro':
        message.angular_velocity_covariance[0] = -1
    return message


def camera_info():
    message = CameraInfo(width=WIDTH, height=HEIGHT, distortion_model='plumb_bob', D=[0.1, -0.02, 0.001, 0.002, 0])
    message.K = [30, 0, 15.5, 0, 31, 11.5, 0, 0, 1]
    message.P = [28, 0, 15, 0, 0, 28, 11, 0, 0, 0, 1, 0]
    if kind == 'other_size':
        message.width = 640
    if kind == 'rational':
        message.distortion_model, message.D = 'rational_polynomial', [0.1] * 8
    if kind == 'uncalibrated':
        message.K = [0] * 9
    return message


events = []  # topic, message, time of recording


def add(topic, message, delay=0.003):
    events.append((topic, message, message.header.stamp + rospy.Duration(nsecs=round(delay * 1e9))))


for k in range(FRAMES):
    if kind == 'compressed':
        message = CompressedImage(format='jpeg', data=open(sys.argv[4], 'rb').read())
        message.header.stamp = at(k / FPS)
        add('/cam0/image_raw/compressed', message)
    elif kind.startswith('mono16'):
        add('/cam0/image_raw', image(k, 'mono16', bits=16))
    elif kind == 'rgb8':
        add('/cam0/image_raw', image(k, 'rgb8', 3))
    elif kind == 'float':
        add('/cam0/image_raw', image(k, '32FC1', 4))
    elif kind == 'rectified':
        add('/cam0/image_rect', image(k))
    else:
        add('/cam0/image_raw', image(k))
    if kind == 'stereo':
        add('/cam1/image_raw', image(k))
        add('/cam1/camera_info', camera_info())
    info = camera_info()
    info.header.stamp = at(k / FPS)
    add('/cam0/camera_info', info)
    height = Range(radiation_type=1, min_range=0.2, max_range=40, range=5 + 0.1 * k)
    if k == 7:
        height.range = math.inf
    height.header.stamp = at(k / FPS)
    add('/altimeter', height)
for k in range(int(IMU_RATE * FRAMES / FPS) + 8 if kind != 'no_imu' else 0):
    add('/imu0', imu(k))
events.sort(key=lambda event: event[2])
if kind == 'unstamped':
    for _, message, _ in events:
        message.header.stamp = rospy.Time()
if kind == 'imu_out_of_order':
    places = [i for i, event in enumerate(events) if event[0] == '/imu0']
    a, b, c = places[10:13]
    events[a], events[b] = (events[a][0], events[b][1], events[a][2]), (events[b][0], events[a][1], events[b][2])
    events[c] = (events[c][0], events[b][1], events[c][2])
if kind == 'repeated_image':
    places = [i for i, event in enumerate(events) if event[0] == '/cam0/image_raw']
    events[places[5]] = (events[places[5]][0], events[places[4]][1], events[places[5]][2])
pictures = [event[1] for event in events if event[0] == '/cam0/image_raw']
samples = [event[1] for event in events if event[0] == '/imu0']
if kind == 'short_image':
    pictures[6].data = b'abc'
if kind == 'mono16_short_first':
    pictures[0].data = b'abc'
YEARS = rospy.Duration(10 * 365 * 24 * 3600)
leaps = {'leaping_images': (pictures, slice(5, 7)), 'leaping_first': (pictures, slice(0, 1)), 'leaping_last': (pictures, slice(-1, None)),
         'clock_set': (pictures, slice(10, None)), 'leaping_imu': (samples, slice(30, 31))}
if kind in leaps:
    messages, where = leaps[kind]
    for message in messages[where]:
        message.header.stamp += YEARS
if kind == 'stamps_back':
    for message in pictures[10:]:
        message.header.stamp -= rospy.Duration(5)
if kind == 'images_unstamped':
    for message in pictures:
        message.header.stamp = rospy.Time()
if kind == 'few_imu':
    events = [event for event in events if event[0] != '/imu0' or event[1] in samples[::26]]
with rosbag.Bag(out, 'w', compression=compression, chunk_threshold=20000) as bag:
    for topic, message, time in events:
        bag.write(topic, message, time)
