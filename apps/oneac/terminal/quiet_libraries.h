#pragma once

namespace oneac::app {

/// Has libraries that log by themselves (Ceres by glog, OpenCV) keep silent: what a user should
/// know, the program says in its own words.
void quiet_libraries();

}  // namespace oneac::app
