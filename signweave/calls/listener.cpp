#include "signweave/calls/listener.h"

namespace signweave::calls {

void report_damage(const Database& database, const Listener& listener) {
  const std::shared_ptr<const Contents> contents = database.contents();
  for (const std::string& fault : contents->faults) listener.report_fault(fault);
}

void learn(Database& database, const Listener& listener) {
  try {
    database.merge();
    database.learn();
  } catch (const Error& error) {
    listener.report_fault(std::string("what was learned: ").append(error.what()));
  }
}

}  // namespace signweave::calls
