#include "nodelets/roscpp/name_claim.h"

#include <condition_variable>
#include <mutex>
#include <set>
#include <stdexcept>

namespace grasp_affordances
{
namespace
{

struct Claims
{
  std::mutex mutex;
  std::condition_variable changed;
  std::set<std::string> names;
};

Claims& claims()
{
  static Claims of_this_process;
  return of_this_process;
}

}  // namespace

NameClaim::~NameClaim()
{
  {
    const std::lock_guard<std::mutex> lock(claims().mutex);
    claims().names.erase(name_);
  }
  claims().changed.notify_all();
}

void NameClaim::claim(const std::string& name)
{
  std::unique_lock<std::mutex> lock(claims().mutex);
  if (!claims().changed.wait_for(lock, longest_wait_, [&] { return claims().names.count(name) == 0; })) {
    throw std::runtime_error("another nodelet of the name " + name + " has been unloaded and does not come to its end");
  }
  claims().names.insert(name);
  name_ = name;
}

}  // namespace grasp_affordances
