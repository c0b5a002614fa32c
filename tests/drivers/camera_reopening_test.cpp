// redbee-camera on a simulated source: when it opens its source again.
#include <gmock/gmock.h>

#include "tests/drivers/camera_node_fixture.hpp"

namespace redbee::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

TEST_F(CameraNodeTest, OpensASourceThatEndsAgainLessAndLessOften) {
  start();
  camera_.open_fault = "no such device";
  node_->processNext();
  EXPECT_EQ(health().message, "no such device");
  passAfter(50ms);
  EXPECT_EQ(camera_.opened, 1);
  passAfter(50ms);
  EXPECT_EQ(camera_.opened, 2);
  passAfter(150ms);
  EXPECT_EQ(camera_.opened, 2);
  camera_.open_fault.clear();
  camera_.fault = "the pipeline has ended";
  camera_.images = {rawGreyMessage(100, testImage(0))};
  passAfter(50ms);
  EXPECT_EQ(camera_.opened, 3);
  EXPECT_EQ(health().state, process_health_t::GOOD);
  node_->processNext();
  EXPECT_EQ(health().message, "the pipeline has ended");
  passAfter(100ms);  // an image came: from the shortest pause again
  EXPECT_EQ(camera_.opened, 4);
}

/// A driver that hangs says nothing.
TEST_F(CameraNodeTest, OpensASourceThatFellSilentAgain) {
  start();
  camera_.images = {rawGreyMessage(100, testImage(0))};
  passAfter(0s);
  passAfter(14s);
  EXPECT_EQ(camera_.opened, 1);
  camera_.images = {rawGreyMessage(200, testImage(1))};
  passAfter(0s);
  passAfter(14s);
  EXPECT_TRUE(camera_.is_open) << "the silence began with the last image";
  passAfter(2s);
  EXPECT_FALSE(camera_.is_open);
  EXPECT_THAT(health().message, HasSubstr("gives no images"));
  camera_.images = {rawGreyMessage(300, testImage(2))};
  passAfter(1s);
  EXPECT_EQ(camera_.opened, 2);
  EXPECT_EQ(published_.size(), 0U) << "until the bus is asked";
  bus_->handle(std::chrono::milliseconds(0));
  EXPECT_EQ(health().state, process_health_t::GOOD);
}

}  // namespace
}  // namespace redbee::test
