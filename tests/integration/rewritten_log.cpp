#include "rewritten_log.h"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/serialization/CArchive.h>

namespace oneac {

void rewrite_log(const std::string& log, const std::string& copy,
                 const std::function<void(mrpt::obs::CObservation&)>& change) {
  mrpt::io::CFileGZInputStream in(log);
  mrpt::io::CFileGZOutputStream out(copy);
  auto from = mrpt::serialization::archiveFrom(in);
  auto to = mrpt::serialization::archiveFrom(out);
  while (!in.checkEOF()) {
    mrpt::serialization::CSerializable::Ptr object;
    try {
      object = from.ReadObject();
    } catch (const mrpt::serialization::CExceptionEOF&) {
      return;
    }
    auto* observation = dynamic_cast<mrpt::obs::CObservation*>(object.get());
    if (observation != nullptr) change(*observation);
    to << *object;
  }
}

}  // namespace oneac
