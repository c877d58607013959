#include "signweave/calls/listener.h"

namespace signweave::calls {

void tell_damage(const Database& database, const Listener& listener) {
  const std::shared_ptr<const Contents> contents = database.contents();
  for (const std::string& fault : contents->faults) listener.blame(fault);
}

void learn(Database& database, const Listener& listener) {
  try {
    database.merge();
    database.learn();
  } catch (const Error& error) {
    listener.blame(std::string("what was learned: ").append(error.what()));
  }
}

}  // namespace signweave::calls
