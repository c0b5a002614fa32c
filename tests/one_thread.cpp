// Linked into every test program and fuzz target: OpenCV computes on one thread, as in every program of ours.
// Its pool (TBB) would be the only one in most tests, and hands its work over in ways that ThreadSanitizer
// does not see; OPENCV_FOR_THREADS_NUM does not reach TBB.
#include <opencv2/core/utility.hpp>

namespace {

[[maybe_unused]] const bool one_thread = (cv::setNumThreads(1), cv::getNumThreads() == 1);

}  // namespace
