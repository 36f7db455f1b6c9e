#pragma once

#include <chrono>
#include <string>

namespace grasp_affordances
{

/// Keeps the nodelets of one name in a process apart in time.
///
/// A manager answers `unload_nodelet` although one of the nodelet's callbacks may still be under way in another thread,
/// which then destroys the nodelet. One of that name that is loaded meanwhile would find its services still advertised,
/// and lose its subscriptions with those of the old one: roscpp knows both by their names.
///
/// A claim is a class's first member, so that it is the last to go. Many threads may have claims.
class NameClaim
{
public:
  explicit NameClaim(std::chrono::milliseconds longest_wait = std::chrono::seconds(10)) : longest_wait_(longest_wait) {}
  ~NameClaim();
  NameClaim(const NameClaim&) = delete;
  NameClaim& operator=(const NameClaim&) = delete;

  /// Claims a name for as long as this exists; first waits until nobody else has it. To be called once.
  /// @throw std::runtime_error when that takes too long
  void claim(const std::string& name);

private:
  const std::chrono::milliseconds longest_wait_;
  std::string name_;  // empty: none
};

}  // namespace grasp_affordances
