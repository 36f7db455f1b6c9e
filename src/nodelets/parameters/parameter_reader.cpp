#include "nodelets/parameters/parameter_reader.h"

namespace grasp_affordances
{
namespace
{

using XmlRpc::XmlRpcValue;

void flatten(const XmlRpcValue& value, const std::string& path, std::map<std::string, XmlRpcValue>& flat)
{
  if (value.getType() != XmlRpcValue::TypeStruct) {
    flat[path] = value;
    return;
  }
  for (const auto& member : value) {
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

/// Whether the value is a list whose entries `append` took.
template <typename Append>
bool readList(XmlRpcValue value, const Append& append)
{
  if (value.getType() != XmlRpcValue::TypeArray) {
    return false;
  }
  for (int i = 0; i < value.size(); ++i) {
    if (!append(value[i])) {
      return false;
    }
  }
  return true;
}

}  // namespace

ParameterReader::ParameterReader(const XmlRpcValue& parameters)
{
  flatten(parameters, "", parameters_);
}

ParameterReader::ParameterReader(const ros::NodeHandle& private_node_handle)
{
  XmlRpcValue parameters;
  if (private_node_handle.getParam(private_node_handle.getNamespace(), parameters)) {
    flatten(parameters, "", parameters_);
  }
}

void ParameterReader::operator()(const std::string& name, bool& field, const std::string& /*description*/)
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

void ParameterReader::operator()(const std::string& name, std::string& field, const std::string& allowed)
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

void ParameterReader::passOver(const std::string& name)
{
  const char after_slash = '/' + 1;  // in the order of the map
  parameters_.erase(parameters_.lower_bound(name + '/'), parameters_.lower_bound(name + after_slash));
}

void ParameterReader::operator()(const std::string& name, std::vector<std::string>& field, const std::string& allowed)
{
  const XmlRpcValue value = take(name);
  if (!value.valid()) {
    return;
  }
  field.clear();
  const bool fits = readList(value, [&](const XmlRpcValue& entry) {
    const bool text = entry.getType() == XmlRpcValue::TypeString;
    if (text) {
      field.push_back(static_cast<const std::string&>(entry));
    }
    return text;
  });
  if (!fits) {
    throw refusal(name, value, allowed);
  }
}

void ParameterReader::operator()(const std::string& name, std::vector<double>& field, const std::string& allowed)
{
  const XmlRpcValue value = take(name);
  if (!value.valid()) {
    return;
  }
  field.clear();
  const bool fits = readList(value, [&](const XmlRpcValue& entry) {
    if (entry.getType() == XmlRpcValue::TypeInt) {
      field.push_back(static_cast<const int&>(entry));
    } else if (entry.getType() == XmlRpcValue::TypeDouble) {
      field.push_back(static_cast<const double&>(entry));
    } else {
      return false;
    }
    return true;
  });
  if (!fits) {
    throw refusal(name, value, allowed);
  }
}

void ParameterReader::refuseRemaining() const
{
  if (!parameters_.empty()) {
    const auto& [name, value] = *parameters_.begin();
    throw ParameterError("parameter ~" + name + " (" + valueText(value) + ") has an unknown name");
  }
}

ParameterError ParameterReader::refusal(const std::string& name, const XmlRpcValue& value, const std::string& allowed)
{
  return ParameterError("parameter ~" + name + " is " + valueText(value) + "; it must be " + allowed);
}

XmlRpcValue ParameterReader::take(const std::string& name)
{
  const auto found = parameters_.find(name);
  if (found == parameters_.end()) {
    return XmlRpcValue();
  }
  const XmlRpcValue value = found->second;
  parameters_.erase(found);
  return value;
}

}  // namespace grasp_affordances
