#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "app/server/control_message.h"

/// Any bytes are read as a control message of a stream or rejected with a ControlError of one line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const signweave::server::ControlMessage message = signweave::server::parse_control(text);
    if (message.open.batch < 1 || message.open.batch > 600 || message.id.size() > 256) std::abort();
  } catch (const signweave::server::ControlError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) std::abort();
  }
  return 0;
}
