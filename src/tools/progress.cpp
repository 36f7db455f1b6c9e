#include "tools/progress.h"

#include <unistd.h>

#include <cmath>
#include <iostream>
#include <utility>

namespace grasp_affordances
{
namespace
{

constexpr std::size_t kBarWidth = 30;

std::string clockTime(double seconds)
{
  const long rounded = std::lround(seconds);
  const std::string rest = std::to_string(rounded % 60);
  return std::to_string(rounded / 60) + ":" + (rest.size() < 2 ? "0" : "") + rest;
}

}  // namespace

Progress::Progress(std::string title, std::size_t steps)
    : title_(std::move(title)), steps_(steps), is_terminal_(isatty(STDERR_FILENO) != 0)
{
}

Progress::~Progress()
{
  if (is_terminal_ && done_ > 0) {
    std::cerr << "\n";
  }
}

void Progress::step()
{
  ++done_;
  const Clock::time_point now = Clock::now();
  if (now - shown_ >= std::chrono::milliseconds(is_terminal_ ? 100 : 30000) || done_ == steps_) {
    shown_ = now;
    show();
  }
}

void Progress::show() const
{
  const double seconds = std::chrono::duration<double>(shown_ - start_).count();
  const double left = seconds * static_cast<double>(steps_ - done_) / static_cast<double>(done_);
  const std::string text = title_ + " " + std::to_string(done_) + "/" + std::to_string(steps_) + ", " +
                           clockTime(seconds) + (done_ < steps_ ? ", " + clockTime(left) + " left" : "");
  if (is_terminal_) {
    const std::size_t filled = kBarWidth * done_ / steps_;
    std::cerr << "\r[" << std::string(filled, '=') << std::string(kBarWidth - filled, ' ') << "] " << text << "   "
              << std::flush;
  } else {
    std::cerr << text << "\n";
  }
}

}  // namespace grasp_affordances
