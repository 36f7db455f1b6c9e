#include "nodelets/parameters/reconfiguration.h"

#include "grasp_affordances/LocalizerConfig.h"
#include "grasp_affordances/parameters.h"

#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <ros/console.h>
#include <ros/master.h>
#include <ros/publisher.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcValue.h>

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

/// Offers what dynamic_reconfigure::Server does. That one sets every parameter by ros::param::set(), which holds a
/// mutex until the master has answered. Where it logs meanwhile, as when the master cannot be reached, the log of
/// roscpp 1.15.9 waits for the same mutex, for ever: it asks for a parameter.
class Reconfiguration::Server
{
public:
  /// Takes values over, or replaces them and returns false.
  using Change = std::function<bool(Message& values)>;

  /// The thread must not have been started, and be stopped before this ends.
  Server(ServiceThread& thread, const ros::NodeHandle& node_handle, Message values, Change change)
      : thread_(thread),
        node_handle_(thread.nodeHandle(node_handle)),
        change_(std::move(change)),
        config_(LocalizerConfig::__getDefault__())
  {
    constexpr bool kLatched = true;
    descriptions_ =
        node_handle_.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, kLatched);
    descriptions_.publish(LocalizerConfig::__getDescriptionMessage__());
    updates_ = node_handle_.advertise<Message>("parameter_updates", 1, kLatched);
    config_.__fromMessage__(values);
    publish();
    service_ = node_handle_.advertiseService("set_parameters", &Server::answer, this);
  }

  ~Server() { thread_.end(service_); }

private:
  using Reconfigure = dynamic_reconfigure::Reconfigure;

  bool answer(Reconfigure::Request& request, Reconfigure::Response& response)
  {
    LocalizerConfig config = config_;
    config.__fromMessage__(request.config);
    config.__clamp__();
    Message values;
    config.__toMessage__(values);
    if (!change_(values)) {
      config.__fromMessage__(values);
    }
    config_ = config;
    response.config = publish();
    return true;
  }

  /// To the parameter server and the topic; returns what.
  Message publish()
  {
    Message message;
    config_.__toMessage__(message);
    const std::string name = node_handle_.resolveName(node_handle_.getNamespace());
    XmlRpc::XmlRpcValue request, response, payload;
    request[0] = ros::this_node::getName();
    request[1] = name;
    request[2] = structOf(message);
    constexpr bool kWaitForMaster = true;
    ros::master::execute("setParam", request, response, payload, kWaitForMaster);
    updates_.publish(message);
    return message;
  }

  ServiceThread& thread_;
  ros::NodeHandle node_handle_;
  const Change change_;
  LocalizerConfig config_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;
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
  server_ = std::make_unique<Server>(thread_, ros::NodeHandle(private_node_handle, kNamespace),
                                     toReconfigureMessage(config), [this](Message& values) { return change(values); });
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

bool Reconfiguration::change(Message& values)
{
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
