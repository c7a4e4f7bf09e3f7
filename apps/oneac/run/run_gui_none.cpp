#include "run_gui.h"

#include "oneac/base/error.h"

namespace oneac::app {

class RunGui::Impl {};

RunGui::RunGui() {
  throw InputError("--gui", "this program was built without windows",
                   "install libmrpt-gui-dev, configure and build again, or leave --gui out");
}

RunGui::~RunGui() = default;
void RunGui::show(const RunMoment& /*moment*/) {}
void RunGui::wait(const DriveRecord& /*record*/) {}

}  // namespace oneac::app
