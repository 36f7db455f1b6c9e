#include "nodelets/parameters_ros.h"

#include "grasp_affordances/parameters.h"

#include <map>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>

namespace grasp_affordances
{
namespace
{

using XmlRpc::XmlRpcValue;
using Parameters = std::map<std::string, XmlRpcValue>;  // by path, as in "hand/capture_radius"

void flatten(XmlRpcValue value, const std::string& path, Parameters& flat)
{
  if (value.getType() != XmlRpcValue::TypeStruct) {
    flat[path] = value;
    return;
  }
  for (auto& member : value) {
    flatten(member.second, path.empty() ? member.first : path + "/" + member.first, flat);
  }
}

std::string valueText(const XmlRpcValue& value)
{
  std::ostringstream text;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      text << (static_cast<const bool&>(value) ? "true" : "false");
      break;
    case XmlRpcValue::TypeInt:
      text << "the integer " << value;
      break;
    case XmlRpcValue::TypeDouble:
      text << "the real number " << value;
      break;
    case XmlRpcValue::TypeString:
      text << "the string '" << value << "'";
      break;
    default:
      text << value;
  }
  return text.str();
}

ParameterError refusal(const std::string& name, const XmlRpcValue& value, const std::string& allowed)
{
  return ParameterError("parameter ~" + name + " is " + valueText(value) + "; it must be " + allowed);
}

template <typename Number>
std::string rangeText(const Range<Number>& range, const std::string& unit)
{
  std::ostringstream text;
  text << (std::is_integral<Number>::value ? "an integer" : "a number") << " in [" << range.min << ", " << range.max
       << "]" << (unit.empty() ? "" : " " + unit);
  return text.str();
}

/// Hands parameters over to the fields that they are meant for; what remains has an unknown name.
class ParameterReader
{
public:
  explicit ParameterReader(Parameters parameters) : parameters_(std::move(parameters)) {}

  template <typename Number>
  void operator()(const std::string& name, Number& field, const Range<Number>& range, const std::string& unit,
                  const std::string& /*description*/)
  {
    const XmlRpcValue value = take(name);
    const bool integer = value.getType() == XmlRpcValue::TypeInt;
    const bool real = value.getType() == XmlRpcValue::TypeDouble;
    if (!value.valid()) {
      return;
    }
    if (!integer && (!real || std::is_integral<Number>::value)) {
      throw refusal(name, value, rangeText(range, unit));
    }
    const double number = integer ? static_cast<const int&>(value) : static_cast<const double&>(value);
    if (!(number >= static_cast<double>(range.min) && number <= static_cast<double>(range.max))) {
      throw refusal(name, value, rangeText(range, unit));
    }
    field = static_cast<Number>(number);
  }

  void operator()(const std::string& name, bool& field, const std::string& /*description*/)
  {
    const XmlRpcValue value = take(name);
    if (!value.valid()) {
      return;
    }
    if (value.getType() != XmlRpcValue::TypeBoolean) {
      throw refusal(name, value, "true or false");
    }
    field = static_cast<const bool&>(value);
  }

  void operator()(const std::string& name, std::string& field, const std::string& allowed)
  {
    const XmlRpcValue value = take(name);
    if (!value.valid()) {
      return;
    }
    if (value.getType() != XmlRpcValue::TypeString) {
      throw refusal(name, value, allowed);
    }
    field = static_cast<const std::string&>(value);
  }

  template <typename Enum>
  std::enable_if_t<std::is_enum<Enum>::value> operator()(const std::string& name, Enum& field,
                                                         const std::string& /*description*/)
  {
    std::string allowed = "one of";
    for (const std::string& word : enumWords<Enum>()) {
      allowed += " " + word;
    }
    std::string word = enumWord(field);
    (*this)(name, word, allowed);
    field = enumFromWord<Enum>(name, word);
  }

  void refuseRemaining() const
  {
    if (!parameters_.empty()) {
      const auto& [name, value] = *parameters_.begin();
      throw ParameterError("parameter ~" + name + " (" + valueText(value) + ") has an unknown name");
    }
  }

private:
  XmlRpcValue take(const std::string& name)  // invalid where there is none
  {
    const auto found = parameters_.find(name);
    if (found == parameters_.end()) {
      return XmlRpcValue();
    }
    const XmlRpcValue value = found->second;
    parameters_.erase(found);
    return value;
  }

  Parameters parameters_;
};

}  // namespace

NodeParameters nodeParameters(const XmlRpcValue& parameters)
{
  Parameters flat;
  flatten(parameters, "", flat);
  ParameterReader read(std::move(flat));

  NodeParameters result;
  std::string preset = result.config.preset;
  read("preset", preset, "the name of a preset");
  result.config = presetConfig(preset);
  visitParameters(result.config, read);
  read("lazy", result.lazy, "");
  read.refuseRemaining();
  validate(result.config);
  return result;
}

NodeParameters nodeParameters(const ros::NodeHandle& private_node_handle)
{
  XmlRpcValue parameters;
  return private_node_handle.getParam(private_node_handle.getNamespace(), parameters) ? nodeParameters(parameters)
                                                                                      : NodeParameters();
}

}  // namespace grasp_affordances
