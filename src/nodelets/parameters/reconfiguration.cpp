#include "nodelets/parameters/reconfiguration.h"

#include "grasp_affordances/LocalizerConfig.h"
#include "grasp_affordances/parameters.h"

#include <dynamic_reconfigure/config_tools.h>
#include <dynamic_reconfigure/server.h>
#include <ros/console.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <boost/thread/recursive_mutex.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <sstream>
#include <type_traits>
#include <utility>

namespace grasp_affordances
{
namespace
{

using dynamic_reconfigure::ConfigTools;
using Message = dynamic_reconfigure::Config;

/// Appends parameters to a message.
class Append
{
public:
  explicit Append(Message& message) : message_(message) {}

  template <typename Number>
  void operator()(const char* name, const Number& field, const Range<Number>&, const char*, const char*) const
  {
    using Sent = std::conditional_t<std::is_same<Number, int>::value, int, double>;
    ConfigTools::appendParameter(message_, flatName(name), static_cast<Sent>(field));
  }

  void operator()(const char* name, const bool& field, const char*) const
  {
    ConfigTools::appendParameter(message_, flatName(name), field);
  }

  template <typename Enum>
  std::enable_if_t<std::is_enum<Enum>::value> operator()(const char* name, const Enum& field, const char*) const
  {
    ConfigTools::appendParameter(message_, flatName(name), enumWord(field));
  }

private:
  Message& message_;
};

/// Takes parameters out of a message.
class Take
{
public:
  explicit Take(const Message& message) : message_(message) {}

  void operator()(const char* name, double& field, const Range<double>&, const char*, const char*) const
  {
    ConfigTools::getParameter(message_, flatName(name), field);
  }

  void operator()(const char* name, int& field, const Range<int>&, const char*, const char*) const
  {
    ConfigTools::getParameter(message_, flatName(name), field);
  }

  void operator()(const char* name, std::uint64_t& field, const Range<std::uint64_t>& range, const char*,
                  const char*) const
  {
    double number = 0.0;
    if (!ConfigTools::getParameter(message_, flatName(name), number)) {
      return;
    }
    const auto min = static_cast<double>(range.min), max = static_cast<double>(range.max);
    if (!(number >= min && number <= max && number == std::floor(number))) {
      std::ostringstream text;
      text << name << ": " << number << " is not a whole number in [" << range.min << ", " << range.max << "]";
      throw ParameterError(text.str());
    }
    field = static_cast<std::uint64_t>(number);
  }

  void operator()(const char* name, bool& field, const char*) const
  {
    ConfigTools::getParameter(message_, flatName(name), field);
  }

  template <typename Enum>
  std::enable_if_t<std::is_enum<Enum>::value> operator()(const char* name, Enum& field, const char*) const
  {
    std::string word;
    if (ConfigTools::getParameter(message_, flatName(name), word)) {
      field = enumFromWord<Enum>(name, word);
    }
  }

private:
  const Message& message_;
};

/// The values as a struct of the parameter server.
XmlRpc::XmlRpcValue structOf(const Message& message)
{
  XmlRpc::XmlRpcValue result;
  for (const auto& value : message.bools) {
    result[value.name] = XmlRpc::XmlRpcValue(static_cast<bool>(value.value));
  }
  for (const auto& value : message.ints) {
    result[value.name] = XmlRpc::XmlRpcValue(value.value);
  }
  for (const auto& value : message.doubles) {
    result[value.name] = XmlRpc::XmlRpcValue(value.value);
  }
  for (const auto& value : message.strs) {
    result[value.name] = XmlRpc::XmlRpcValue(value.value);
  }
  return result;
}

}  // namespace

std::string flatName(const std::string& path)
{
  std::string name = path;
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

Message toReconfigureMessage(const Config& config)
{
  Message message;
  visitParameters(config, Append(message));
  return message;
}

void assign(const Message& message, Config& config)
{
  visitParameters(config, Take(message));
}

/// dynamic_reconfigure's server and the lock that it needs, which outlives it.
class Reconfiguration::Server
{
public:
  explicit Server(const ros::NodeHandle& node_handle) : server_(mutex_, node_handle) {}

  /// `change` takes values over, or replaces them and returns false. First it is told of those at the start.
  void start(std::function<bool(Message& values, bool starting)> change)
  {
    server_.setCallback([change = std::move(change)](LocalizerConfig& config, std::uint32_t level) {
      Message values;
      config.__toMessage__(values);
      if (!change(values, level == kStarting)) {
        config.__fromMessage__(values);
      }
    });
  }

private:
  static constexpr std::uint32_t kStarting = ~std::uint32_t{0};  // all bits; our parameters have none

  boost::recursive_mutex mutex_;
  dynamic_reconfigure::Server<LocalizerConfig> server_;
};

Reconfiguration::Reconfiguration() = default;

Reconfiguration::~Reconfiguration()
{
  close();
}

void Reconfiguration::advertise(const ros::NodeHandle& private_node_handle, const std::string& logger,
                                const Config& config)
{
  logger_ = logger;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    config_ = config;
  }
  const ros::NodeHandle node_handle(thread_.nodeHandle(private_node_handle), kNamespace);
  node_handle.setParam(node_handle.getNamespace(), structOf(toReconfigureMessage(config)));
  server_ = std::make_unique<Server>(node_handle);
  server_->start([this](Message& values, bool starting) { return change(values, starting); });
  thread_.start();
}

void Reconfiguration::close()
{
  thread_.stop();
  server_.reset();
}

Config Reconfiguration::config() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return config_;
}

bool Reconfiguration::change(Message& values, bool starting)
{
  if (starting) {  // what came from the parameter server may have lost digits on its way
    values = toReconfigureMessage(config());
    return false;
  }
  Config changed = config();
  try {
    assign(values, changed);
    validate(changed);
  } catch (const ParameterError& error) {
    ROS_ERROR_STREAM_NAMED(logger_, "parameters are put back as " << error.what());
    values = toReconfigureMessage(config());
    return false;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  config_ = changed;
  return true;
}

}  // namespace grasp_affordances
