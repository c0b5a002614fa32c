#include "redbee/inertial/lens_track.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/sampled_track.hpp"

namespace redbee::test {
namespace {

/// Doubles its focal length every second.
LensTrack track(const LensParameters& parameters = {}) {
  return sampledTrack<LensTrack>(parameters, [](double t_s) { return LensSample{at(t_s), std::exp2(t_s)}; });
}

TEST(LensTrack, ASteadyZoomIsInterpolatedExactly) {
  const LensTrack lens = track();
  for (const double t_s : {0.0, 0.03, 0.1, 0.55, 1.0}) {
    const Zoom zoom = lens.at(at(t_s));
    EXPECT_TRUE(zoom.is_known) << t_s;
    EXPECT_NEAR(zoom.value, std::exp2(t_s), 1e-9) << t_s;
    EXPECT_DOUBLE_EQ(zoom.variance, 1e-6);
  }
  EXPECT_TRUE(lens.reaches(at(1)));
  EXPECT_FALSE(lens.reaches(at(1.001)));
}

TEST(LensTrack, WhereNothingIsSaidItIsTheNearestOnesAndUncertain) {
  const LensTrack lens = track();
  const Zoom soon = lens.at(at(1.1)), late = lens.at(at(2)), before = lens.at(at(-0.5));
  for (const Zoom& guess : {soon, late}) {
    EXPECT_FALSE(guess.is_known);
    EXPECT_DOUBLE_EQ(guess.value, 2);
  }
  EXPECT_DOUBLE_EQ(before.value, 1);
  EXPECT_GT(soon.variance, 1e-6);
  EXPECT_GT(late.variance, 10 * soon.variance);
  EXPECT_LE(std::log(2), 2 * std::sqrt(late.variance)) << "two sigma cover a zoom that goes on";
}

TEST(LensTrack, InALongGapItIsAGuess) {
  LensTrack lens{LensParameters()};
  lens.add({at(0), 1});
  lens.add({at(1), 2});
  EXPECT_DOUBLE_EQ(lens.at(at(0.4)).value, 1);
  EXPECT_DOUBLE_EQ(lens.at(at(0.6)).value, 2);
  EXPECT_FALSE(lens.at(at(0.4)).is_known);
  EXPECT_TRUE(lens.at(at(1)).is_known);
}

/// As MAVLink's cameras do: once a second.
TEST(LensTrack, ALensThatSeldomSpeaksStandsStillUntilItSaysOtherwise) {
  LensTrack lens{LensParameters()};
  lens.add({at(0), 1.5});
  EXPECT_FALSE(lens.at(at(0.5)).is_known) << "one message says nothing of its motion";
  lens.add({at(1), 1.5});
  for (const double t_s : {0.5, 1.0, 1.7, 2.4}) {
    EXPECT_TRUE(lens.reaches(at(t_s))) << t_s;
    EXPECT_TRUE(lens.at(at(t_s)).is_known) << t_s;
    EXPECT_DOUBLE_EQ(lens.at(at(t_s)).value, 1.5);
  }
  EXPECT_FALSE(lens.reaches(at(2.6))) << "the next is overdue";
  EXPECT_FALSE(lens.at(at(2.6)).is_known);
  lens.add({at(2), 1.6});
  EXPECT_FALSE(lens.reaches(at(2.2)));
  EXPECT_FALSE(lens.at(at(1.5)).is_known);
}

/// Also once what is older than a second has been erased, as the filter does.
TEST(LensTrack, ALensThatStandsStillIsKnownBetweenRareMessages) {
  LensTrack lens{LensParameters()};
  for (const double t_s : {0.0, 2.0}) lens.add({at(t_s), 1.5});
  for (const double t_s : {2.5, 3.5, 4.5}) {
    lens.eraseBefore(at(t_s - 1));
    EXPECT_TRUE(lens.reaches(at(t_s))) << t_s;
    EXPECT_TRUE(lens.at(at(t_s)).is_known) << t_s;
  }
}

TEST(LensTrack, WithoutAnyMessageTheConfiguredFocalLengthHolds) {
  const Zoom zoom = LensTrack(LensParameters()).at(at(0));
  EXPECT_EQ(zoom.value, 1);
  EXPECT_GE(2 * std::sqrt(zoom.variance), std::log(4)) << "any zoom may be set when the process starts";
  EXPECT_FALSE(zoom.is_known) << "and it is said";
}

TEST(LensTrack, OrderDoesNotMatterAndALateLensIsShifted) {
  LensParameters parameters;
  parameters.timeshift_s = -0.05;
  LensTrack lens(parameters);
  for (const double t_s : {0.2, 0.0, 0.1}) EXPECT_TRUE(lens.add({at(t_s), std::exp2(t_s)}));
  EXPECT_NEAR(lens.at(at(0.1)).value, std::exp2(0.15), 1e-9);
}

/// What was written beside the images has their times.
TEST(LensTrack, ALensOnTheCamerasClockIsShiftedAsTheImagesAre) {
  LensParameters parameters;
  parameters.on_camera_clock = true;
  LensTrack with(parameters, fromSeconds(0.03)), without(LensParameters(), fromSeconds(0.03));
  for (const double t_s : {0.0, 0.1, 0.2}) {
    with.add({at(t_s), std::exp2(t_s)});
    without.add({at(t_s), std::exp2(t_s)});
  }
  EXPECT_NEAR(with.at(at(0.13)).value, std::exp2(0.1), 1e-9);
  EXPECT_NEAR(without.at(at(0.13)).value, std::exp2(0.13), 1e-9);
}

TEST(LensTrack, WhatNoLensHasIsRefused) {
  LensTrack lens{LensParameters()};
  for (const double zoom : {0.0, -1.0, 101.0, 0.009, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_FALSE(lens.add({at(0), zoom})) << zoom;
}

TEST(LensTrack, AClockThatWasSetBackForgetsWhatCameBefore) {
  LensTrack lens = track();
  EXPECT_TRUE(lens.add({at(-100), 3}));
  EXPECT_DOUBLE_EQ(lens.at(at(-100)).value, 3);
  EXPECT_DOUBLE_EQ(lens.at(at(0.5)).value, 3);
}

TEST(ZoomOf, IsInProportionToWhatTheLensSaysAtTheConfiguredFocalLength) {
  LensParameters parameters;
  EXPECT_DOUBLE_EQ(*zoomOf({1000, std::nullopt}, 500, parameters), 2);
  parameters.focal_length_px = 800;
  EXPECT_DOUBLE_EQ(*zoomOf({1000, std::nullopt}, 500, parameters), 1.25);
  EXPECT_FALSE(zoomOf({std::nullopt, 0.5}, 500, parameters)) << "the range's width is not known";
  parameters.zoom_range = 3;
  EXPECT_DOUBLE_EQ(*zoomOf({std::nullopt, 0.5}, 500, parameters), 2);
  EXPECT_DOUBLE_EQ(*zoomOf({1000, 0.5}, 500, parameters), 1.25) << "a stated focal length counts first";
}

/// As of MAVLink's cameras, which state the maker's focal length at the wide end alone.
TEST(ZoomOf, LeavesTheWideEndWithoutAStep) {
  LensParameters parameters;
  parameters.zoom_range = 3;
  const double maker_px = 520, calibrated_px = 500;
  EXPECT_DOUBLE_EQ(*zoomOf({maker_px, 0.0}, calibrated_px, parameters), 1);
  EXPECT_NEAR(*zoomOf({std::nullopt, 0.001}, calibrated_px, parameters), 1.002, 1e-9);
}

}  // namespace
}  // namespace redbee::test
