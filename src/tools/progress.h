#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace grasp_affordances
{

/// Shows on stderr how far a long job is: a bar on a terminal, elsewhere a line now and then.
class Progress
{
public:
  Progress(std::string title, std::size_t steps);
  ~Progress();  ///< ends the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void step();

private:
  using Clock = std::chrono::steady_clock;

  void show() const;

  const std::string title_;
  const std::size_t steps_;
  const bool is_terminal_;
  std::size_t done_ = 0;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = start_;
};

}  // namespace grasp_affordances
