#pragma once

#include <mutex>

namespace grasp_affordances
{

/// A mutex of the whole process, to be held while a nodelet subscribes to a topic or ends a subscription. roscpp loses
/// a subscription that begins while the last other one of its topic in the process ends: nothing ever arrives, and
/// nothing is said. So it was where a client went from one lazy localizer of a manager to another one. The callback of
/// a subscription must not take it: the end of the subscription waits for the callback.
std::mutex& subscribing();

}  // namespace grasp_affordances
