#pragma once

#include "grasp_affordances/parameters.h"

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace grasp_affordances
{

/// Hands a node's private parameters over to the fields that they are meant for. Every call names a parameter, by path
/// as in "hand/capture_radius", and leaves the field alone where there is none of that name.
/// @throw ParameterError with name, value and allowed values for a wrong type (an integer is fine for a real number,
/// and a whole real number where integers of 32 bits are too short) or a value outside its range.
class ParameterReader
{
public:
  explicit ParameterReader(const XmlRpc::XmlRpcValue& parameters);

  /// All private parameters on the parameter server.
  explicit ParameterReader(const ros::NodeHandle& private_node_handle);

  template <typename Number>
  void operator()(const std::string& name, Number& field, const Range<Number>& range, const std::string& unit,
                  const std::string& /*description*/)
  {
    const XmlRpc::XmlRpcValue value = take(name);
    if (!value.valid()) {
      return;
    }
    const bool integer = value.getType() == XmlRpc::XmlRpcValue::TypeInt;
    const bool real = value.getType() == XmlRpc::XmlRpcValue::TypeDouble;
    double number = std::nan("");
    if (integer) {
      number = static_cast<const int&>(value);
    } else if (real) {
      number = static_cast<const double&>(value);
    }
    const bool fits = std::is_floating_point<Number>::value || integer ||
                      (sizeof(Number) > sizeof(int) && number == std::floor(number));
    if (!fits || !(number >= static_cast<double>(range.min) && number <= static_cast<double>(range.max))) {
      std::ostringstream allowed;
      allowed << (std::is_integral<Number>::value ? "an integer" : "a number") << " in [" << range.min << ", "
              << range.max << "]" << (unit.empty() ? "" : " " + unit);
      throw refusal(name, value, allowed.str());
    }
    field = static_cast<Number>(number);
  }

  void operator()(const std::string& name, bool& field, const std::string& description);

  /// `allowed` says what the string should be.
  void operator()(const std::string& name, std::string& field, const std::string& allowed);

  /// Lists; `allowed` says what they should be.
  void operator()(const std::string& name, std::vector<std::string>& field, const std::string& allowed);
  void operator()(const std::string& name, std::vector<double>& field, const std::string& allowed);

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

  /// Passes over all that lies below a name: it is not meant for the node.
  void passOver(const std::string& name);

  /// @throw ParameterError where a parameter was not asked for: its name is unknown.
  void refuseRemaining() const;

private:
  static ParameterError refusal(const std::string& name, const XmlRpc::XmlRpcValue& value, const std::string& allowed);
  XmlRpc::XmlRpcValue take(const std::string& name);  // invalid where there is none

  std::map<std::string, XmlRpc::XmlRpcValue> parameters_;  // by path
};

}  // namespace grasp_affordances
