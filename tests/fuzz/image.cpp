// The content of an image file: JPEG, PNG, whatever OpenCV takes for one.
#include "fuzz.h"

#include "oneac/base/error.h"
#include "oneac/observations/image_decoding.h"

ONEAC_FUZZ_TARGET(image) {
  try {
    const oneac::GreyImage grey = oneac::decode_grey_bytes({data.begin(), data.end()}, "image");
    oneac::fuzz::check(!grey.empty(), "8-bit grey");
  } catch (const oneac::InputError&) {  // what it may throw
  }
}
