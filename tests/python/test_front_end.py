import logging
import re

import conftest
import numpy as np
import pytest

import oneac

CAMERA = oneac.Camera(480, 360, 375, 375, 239.5, 179.5)


def frames_of(drive, **options):
    return list(oneac.Rawlog(drive / "simulated.rawlog", **options))


def test_a_log_gives_frames_with_stamps(drive):
    log = oneac.Rawlog(drive / "simulated.rawlog")
    frames = list(log)
    assert [frame.index for frame in frames] == list(range(24))
    assert (np.diff([frame.time_s for frame in frames]) > 0).all()
    first = frames[0]
    assert first.image.shape == (360, 480) and first.image.dtype == np.uint8
    assert not first.image.flags.writeable and first.right is None
    assert first.camera.K.shape == (3, 3) and first.camera.K[0, 0] == 375
    assert first.T_vehicle_cam.shape == (4, 4)
    assert log.report.images_in_log == 24 and log.report.damage == ""
    every = frames_of(drive, first=2, every=5, count=3)
    assert [frame.index for frame in every] == [2, 7, 12]


def test_a_log_is_read_anew_by_each_loop(drive):
    log = oneac.Rawlog(drive / "simulated.rawlog", first=2)
    for frame in log:
        if frame.index == 5:
            break
    assert log.report.images_in_log < 24
    for _ in range(2):
        assert [frame.index for frame in log] == list(range(2, 24))
        assert log.report.images_in_log == 24
    assert next(log, None) is None


def test_passes_over_a_log_do_not_disturb_each_other(drive):
    log = oneac.Rawlog(drive / "simulated.rawlog")
    assert [(a.index, b.index) for a, b in zip(log, log)] == [(i, i) for i in range(24)]
    frames = iter(log)
    assert iter(frames) is frames and next(frames).index == 0
    assert next(log).index == 1  # of the newest pass
    assert next(iter(log)).index == 0 and next(frames).index == 2
    fresh = oneac.Rawlog(drive / "simulated.rawlog")
    assert (next(fresh).index, next(fresh).index, next(iter(fresh)).index) == (0, 1, 0)


def test_a_pass_outlives_its_log(drive):
    frames = iter(oneac.Rawlog(drive / "simulated.rawlog", count=3))
    assert [frame.index for frame in frames] == [0, 1, 2]


def test_an_image_outlives_its_frame(drive):
    image = frames_of(drive, count=1)[0].image
    again = frames_of(drive, count=1)[0].image
    np.testing.assert_array_equal(image, again)


def test_frames_give_the_poses_of_oneac_run(drive, result):
    front_end = oneac.FrontEnd()
    steps = [front_end.process(frame).step for frame in frames_of(drive)]
    front_end.finish()
    run = oneac.read_run(result)
    np.testing.assert_array_equal(front_end.trajectory.positions, run.trajectory.positions)
    np.testing.assert_allclose(front_end.trajectory.T, run.trajectory.T, atol=1e-12)
    np.testing.assert_array_equal(front_end.relative_poses.t, run.relative_poses.t)
    np.testing.assert_array_equal(front_end.relative_poses.sigma_length,
                                  run.relative_poses.sigma_length)
    assert steps[0] is None and steps[1].covariance.shape == (6, 6)
    assert front_end.relative_poses.metric.all() and front_end.setup_faults == []


def test_bare_images_give_the_same_poses(drive):
    frames = frames_of(drive)
    mount = frames[0].T_vehicle_cam
    camera = frames[0].camera
    by_frames = oneac.FrontEnd()
    by_images = oneac.FrontEnd(camera, T_vehicle_cam=mount)
    for frame in frames:
        by_frames.process(frame)
        found = by_images.feed(frame.image, frame.time_s)
        assert found.time_s == pytest.approx(frame.time_s, abs=1e-6)
    np.testing.assert_allclose(by_images.trajectory.T, by_frames.trajectory.T, atol=1e-6)
    assert by_images.camera_height == pytest.approx(mount[2, 3])
    u1, u2, A = by_images.correspondences
    assert u1.shape == u2.shape == (len(A), 2) and len(A) > 100


def test_threads_change_no_result(drive):
    alone, shared = oneac.FrontEnd(), oneac.FrontEnd(threads=3)
    for frame in frames_of(drive, count=12):
        one, other = alone.process(frame), shared.process(frame)
        np.testing.assert_array_equal(one.T_first_cam, other.T_first_cam)
    with pytest.raises(ValueError, match="threads = 0, must be at least 1"):
        oneac.FrontEnd(threads=0)


def half(frame):
    """Nothing of the left half is used."""
    mask = np.full(frame.image.shape, 255, np.uint8)
    mask[:, : mask.shape[1] // 2] = 0
    return mask


def test_nothing_is_made_of_what_a_mask_hides(drive):
    frames = frames_of(drive, count=6)
    live = oneac.FrontEnd(frames[0].camera, camera_height=1.65)
    frame_by_frame = oneac.FrontEnd(camera_height=1.65)
    for f in frames:
        live.feed(f.image, f.time_s, mask=half(f))
        frame_by_frame.process(oneac.Frame(f.image, f.time_s, f.camera, f.index, mask=half(f)))
    for front_end in (live, frame_by_frame):
        assert front_end.correspondences.u2[:, 0].min() > frames[0].camera.width / 2 - 1
    with pytest.raises(ValueError, match="mask .*100x90.*480x360|mask .*90.*must be"):
        live.feed(frames[0].image, frames[-1].time_s + 1, mask=np.zeros((90, 100), np.uint8))
    with pytest.raises(ValueError, match="mask is no array|mask has shape"):
        live.feed(frames[0].image, frames[-1].time_s + 2, mask="mask.png")


def test_a_log_reads_masks_beside_its_images(drive, tmp_path):
    names = [frame.name for frame in frames_of(drive)]
    for name in names:
        (tmp_path / (name.rsplit(".", 1)[0] + ".pgm")).write_bytes(
            b"P5\n480 360\n255\n" + bytes([0]) * (480 * 180) + bytes([255]) * (480 * 180))
    frame = frames_of(drive, count=1, mask_dir=tmp_path)[0]
    assert frame.mask[0, 0] == 0 and frame.mask[-1, -1] == 255 and frame.right_mask is None
    (tmp_path / (names[1].rsplit(".", 1)[0] + ".pgm")).unlink()
    with pytest.raises(oneac.InputError, match="no mask for image"):
        frames_of(drive, mask_dir=tmp_path)


def test_right_images_give_metres(drive):
    frames = frames_of(drive, count=8)
    height, width = frames[0].image.shape
    disparity = 16
    stereo = oneac.FrontEnd(scale={"source": "stereo"})
    for f in frames:
        right = np.roll(f.image, -disparity, axis=1)
        pair = oneac.Frame(f.image, f.time_s, f.camera, f.index, f.T_vehicle_cam, right=right,
                           baseline_m=0.5)
        assert pair.right.shape == (height, width) and pair.baseline_m == 0.5
        stereo.process(pair)
    for extra in ({"right": right}, {"baseline_m": 0.5}, {"right": right, "baseline_m": np.nan}):
        with pytest.raises(ValueError, match="baseline_m"):
            oneac.Frame(f.image, f.time_s, f.camera, **extra)
    with pytest.raises(ValueError, match="right_mask has 9x9 px, the image has 480x360"):
        oneac.Frame(f.image, f.time_s, f.camera, right_mask=np.zeros((9, 9), np.uint8))


def test_a_front_end_says_what_it_believes(drive):
    front_end = oneac.FrontEnd(calibration={"refine": "focal"})
    gps, imu = oneac.read_sensors(drive / "simulated.rawlog")
    for time, rate in zip(imu.time_s, imu.angular_rate):
        front_end.add_yaw_rate(time, rate[2])
    for time, course, speed in zip(gps.time_s, gps.course, gps.speed):
        if np.isfinite(course) and np.isfinite(speed):
            front_end.add_course(time, course, speed)
    for frame in frames_of(drive):
        front_end.process(frame)
    front_end.finish()
    tilt, camera = front_end.tilt, front_end.camera_belief
    assert abs(tilt.pitch_up) < 0.3 and 0 < tilt.pitch_sigma < 0.1 and tilt.roll_sigma > 0
    assert camera.given.focal_px == pytest.approx(375)
    assert camera.used.focal_px == pytest.approx(camera.focal_px, rel=0.05)
    assert camera.bends >= 0 and camera.sensors == [] and camera.contradicting == []
    assert 0 <= camera.doubt < 1 and camera.knows_focal in (True, False)
    assert 0 < front_end.scale_uncertainty < 0.1 and front_end.length_doubt >= 0
    assert not front_end.stamps_are_wrong and not front_end.car_mask_refused
    with pytest.raises(ValueError, match="yaw_rate"):
        front_end.add_yaw_rate(1.0, np.nan)
    with pytest.raises(ValueError, match="speed"):
        front_end.add_course(1.0, 0.0, -1.0)


def test_the_mount_can_be_given(drive):
    frame = frames_of(drive, count=1, mount_deg=(0, 5, 180))[0]
    np.testing.assert_allclose(frame.T_vehicle_cam[:3, :3],
                               oneac.mount(0, 5, 180)[:3, :3], atol=1e-12)
    with pytest.raises(ValueError, match="pitch"):
        frames_of(drive, mount_deg=(0, 95, 0))


def test_wheels_of_a_log_are_speeds(tmp_path):
    conftest.oneac("simulate", "-o", tmp_path, "--frames", 24, "--width", 160, "--height", 120,
                   "--focal", 125, "--odometry")
    log = oneac.Rawlog(tmp_path / "simulated.rawlog")
    told = [log.take_wheels() for _ in log]
    assert sum(map(len, told)) > 2 and log.report.wheel_readings > 3
    times = np.concatenate([speeds.time_s for speeds in told])
    assert (np.diff(times) > 0).all() and all((speeds.speed >= 0).all() for speeds in told)
    front_end = oneac.FrontEnd(scale={"source": "wheels"})
    for speeds in told:
        for time, speed, sigma in zip(speeds.time_s, speeds.speed, speeds.sigma):
            front_end.add_speed(time, speed, sigma)
    assert len(log.take_wheels()) == 0


def test_colour_images_are_rgb(drive):
    grey = frames_of(drive, count=2)
    colour = oneac.FrontEnd(grey[0].camera, camera_height=1.65)
    bare = oneac.FrontEnd(grey[0].camera, camera_height=1.65)
    for frame in grey:
        three = np.repeat(frame.image[:, :, None], 3, axis=2)
        found, expected = colour.feed(three, frame.time_s), bare.feed(frame.image, frame.time_s)
    np.testing.assert_allclose(found.T_first_cam, expected.T_first_cam, atol=1e-9)


def test_an_image_that_comes_late_gives_nothing(drive, caplog):
    front_end = oneac.FrontEnd(CAMERA, camera_height=1.65)
    image = np.zeros((360, 480), np.uint8)
    assert front_end.feed(image, 10.0) is not None
    with caplog.at_level(logging.DEBUG, logger="oneac"):
        assert front_end.feed(image, 9.0) is None
    assert "not later" in caplog.text or "passed over" in caplog.text
    assert front_end.feed(image + 1, 10.1) is not None


@pytest.mark.parametrize("image", [np.zeros((360, 480)), np.zeros((360, 480, 4), np.uint8),
                                   np.zeros((0, 0), np.uint8), np.zeros(5, np.uint8), "image.png",
                                   np.zeros((360, 480), np.uint16)])
def test_what_is_no_image_is_refused(image):
    with pytest.raises(ValueError, match="image .*must be"):
        oneac.FrontEnd(CAMERA).feed(image, 1.0)


def test_an_image_with_masked_pixels_is_refused():
    pixels = np.ma.masked_array(np.zeros((360, 480), np.uint8), False)
    assert oneac.FrontEnd(CAMERA).feed(pixels, 1.0) is not None
    pixels[0, 0] = np.ma.masked
    with pytest.raises(ValueError, match="image has masked entries"):
        oneac.FrontEnd(CAMERA).feed(pixels, 1.0)


def told(call):
    """The message of an InputError."""
    with pytest.raises(oneac.InputError) as caught:
        call()
    return str(caught.value)


def test_messages_name_arguments_and_no_flags(drive, tmp_path):
    log = drive / "simulated.rawlog"
    for options, words in (({"every": 0}, "^every=0: "),
                           ({"undistorted_fov_deg": 5}, "^undistorted_fov_deg=5: "),
                           ({"images_dir": tmp_path / "none"}, "log's images with images_dir$"),
                           ({"mask_dir": tmp_path}, "masks with mask_dir$"),
                           ({"calibration": oneac.Camera(90, 100, 99, 99, 45, 50)},
                            r"with calibration='FILE\[:SECTION\]' or a Camera")):
        message = told(lambda: list(oneac.Rawlog(log, **options)))
        assert re.search(words, message) and "--" not in message, message
    other = np.zeros((90, 100), np.uint8)
    message = told(lambda: oneac.FrontEnd(CAMERA).feed(other, 1.0))
    assert re.search("100x90.*480x360; give the calibration of these .* with camera$", message)


def test_setup_faults_name_arguments_and_no_flags(drive):
    frames = frames_of(drive)
    start = frames[0].time_s
    for camera, hurry, words in ((CAMERA, 10, r"the camera's height \(camera_height\)$"),
                                 (oneac.Camera(480, 360, 20, 20, 240, 180), 1, "with camera$")):
        front_end = oneac.FrontEnd(camera, camera_height=1.65)
        for frame in frames:
            front_end.feed(frame.image, start + (frame.time_s - start) / hurry)
        assert re.search(words, front_end.setup_faults[0]), front_end.setup_faults
        assert "--" not in front_end.setup_faults[0]


def test_misuse_is_a_value_error_that_names_it():
    image = np.zeros((360, 480), np.uint8)
    with pytest.raises(ValueError, match="need a camera"):
        oneac.FrontEnd().feed(image, 1.0)
    with pytest.raises(ValueError, match="time_s"):
        oneac.FrontEnd(CAMERA).feed(image, np.nan)
    with pytest.raises(ValueError, match="100x90"):
        oneac.FrontEnd(CAMERA).feed(np.zeros((90, 100), np.uint8), 1.0)
    with pytest.raises(ValueError, match="camera_height"):
        oneac.FrontEnd(CAMERA, camera_height=165)
    with pytest.raises(ValueError, match="tilt.sorce.*tilt.source"):
        oneac.FrontEnd(CAMERA, tilt={"sorce": "drive"})
    with pytest.raises(ValueError, match="oneac.Camera"):
        oneac.FrontEnd(np.eye(3))
    with pytest.raises(ValueError, match="T_vehicle_cam is no rigid"):
        oneac.FrontEnd(CAMERA, T_vehicle_cam=np.ones((4, 4)))
    with pytest.raises(ValueError, match="fx"):
        oneac.Camera(480, 360, -1, 375, 240, 180)
    with pytest.raises(ValueError, match="speed"):
        oneac.FrontEnd(CAMERA).add_speed(1.0, -5.0)
    with pytest.raises(ValueError, match="acceleration"):
        oneac.FrontEnd(CAMERA).add_acceleration(1.0, [0, np.nan, 9.8])


def test_a_frame_can_be_made_of_an_image(drive):
    frames = frames_of(drive, count=3)
    made = [oneac.Frame(f.image, f.time_s, f.camera, f.index, f.T_vehicle_cam) for f in frames]
    first, second = oneac.FrontEnd(), oneac.FrontEnd()
    for frame, copy in zip(frames, made):
        one, other = first.process(frame), second.process(copy)
    np.testing.assert_array_equal(one.T_first_cam, other.T_first_cam)
    with pytest.raises(ValueError, match="480x360"):
        oneac.Frame(np.zeros((9, 9), np.uint8), 0.0, frames[0].camera)


def test_a_log_that_is_not_there_is_an_input_error(tmp_path):
    with pytest.raises(oneac.InputError, match="no such file"):
        oneac.Rawlog(tmp_path / "none.rawlog")


def test_a_damaged_log_gives_what_comes_before(drive, tmp_path):
    whole = (drive / "simulated.rawlog").read_bytes()
    (tmp_path / "cut.rawlog").write_bytes(whole[: len(whole) // 2])
    log = oneac.Rawlog(tmp_path / "cut.rawlog", images_dir=drive / "Images")
    assert 5 < len(list(log)) < 20
    assert "cut.rawlog" in log.report.damage


def test_sensors_are_arrays(drive):
    gps, imu = oneac.read_sensors(drive / "simulated.rawlog")
    assert gps.position_enu.shape == (len(gps.time_s), 3) and len(gps.time_s) > 1
    assert imu.acceleration.shape == imu.angular_rate.shape == (len(imu.time_s), 3)
    assert np.median(imu.acceleration[:, 2]) == pytest.approx(9.8, abs=0.5)
    assert "CAMERA" in oneac.describe_log(drive / "simulated.rawlog")
