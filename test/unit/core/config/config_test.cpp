#include "grasp_affordances/parameters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace grasp_affordances::test
{
namespace
{

std::string textOfFile(const std::string& path)
{
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Every parameter's value as text, and its documentation.
class Listing
{
public:
  std::map<std::string, std::string> values;
  std::map<std::string, std::string> table_rows;  // of docs/parameters.md

  template <typename T>
  void operator()(const char* name, const T& value, const Range<T>& range, const char* unit, const char* description)
  {
    values[name] = text(value);
    table_rows[name] = row(name, unit, text(value), text(range.min) + " to " + text(range.max), description);
  }

  void operator()(const char* name, const bool& value, const char* description)
  {
    values[name] = value ? "true" : "false";
    table_rows[name] = row(name, "", values[name], "true, false", description);
  }

  template <typename Enum>
  void operator()(const char* name, const Enum& value, const char* description)
  {
    std::string words;
    for (const std::string& word : enumWords<Enum>()) {
      words += (words.empty() ? "" : ", ") + word;
    }
    values[name] = enumWord(value);
    table_rows[name] = row(name, "", values[name], words, description);
  }

private:
  template <typename T>
  static std::string text(const T& value)
  {
    std::ostringstream stream;
    stream << value;
    return stream.str();
  }

  static std::string row(const std::string& name, const std::string& unit, const std::string& value,
                         const std::string& range, const std::string& description)
  {
    return "| `" + name + "` | " + value + " | " + unit + " | " + range + " | " + description + " |";
  }
};

Listing listingOf(const Config& config)
{
  Listing listing;
  visitParameters(config, listing);
  return listing;
}

class PresetFile : public testing::TestWithParam<std::string>
{
};

TEST_P(PresetFile, HoldsEveryParameterOfThePresetAndNothingElse)
{
  const std::string text = textOfFile(GRASP_AFFORDANCES_SOURCE_DIR "/config/" + GetParam() + ".yaml");
  const Config from_file = configFromYaml(text, Config());
  EXPECT_EQ(from_file.preset, GetParam());
  EXPECT_EQ(listingOf(from_file).values, listingOf(presetConfig(GetParam())).values);
  for (const auto& parameter : listingOf(Config()).values) {
    const std::string key = parameter.first.substr(parameter.first.find('/') + 1);
    EXPECT_NE(text.find(key + ": "), std::string::npos) << parameter.first << " is not in the file";
  }
}

INSTANTIATE_TEST_SUITE_P(Config, PresetFile, testing::ValuesIn(presetNames()),
                         [](const testing::TestParamInfo<std::string>& info) { return info.param; });

TEST(Presets, AreValidAndPaperHasThePapersNumbers)
{
  for (const std::string& name : presetNames()) {
    EXPECT_NO_THROW(validate(presetConfig(name))) << name;
  }
  const Config paper = presetConfig("paper");
  EXPECT_DOUBLE_EQ(paper.hand.capture_radius, 0.026);
  EXPECT_DOUBLE_EQ(paper.hand.finger_thickness, 0.008);
  EXPECT_EQ(paper.sampling.samples, 4000);
  EXPECT_EQ(paper.neighborhood.k, 500);
  EXPECT_EQ(paper.occlusion.max_points_in_front, 20);
  EXPECT_EQ(paper.shell.gap_points_to_block, 5);
  EXPECT_EQ(paper.shell.min_points_inside, 40);
  EXPECT_FALSE(paper.estimation.reject_concave);
}

TEST(Documentation, DescribesEveryParameterAsItIs)
{
  const std::string page = textOfFile(GRASP_AFFORDANCES_SOURCE_DIR "/docs/parameters.md");
  for (const auto& row : listingOf(Config()).table_rows) {
    EXPECT_NE(page.find(row.second), std::string::npos) << row.second;
  }
}

/// Files of config/hands, without `.yaml`.
std::vector<std::string> handNames()
{
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(GRASP_AFFORDANCES_SOURCE_DIR "/config/hands")) {
    EXPECT_EQ(entry.path().extension(), ".yaml") << entry.path();
    names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class HandFile : public testing::TestWithParam<std::string>
{
};

TEST_P(HandFile, HoldsAHandAndNothingElse)
{
  const std::string path = GRASP_AFFORDANCES_SOURCE_DIR "/config/hands/" + GetParam() + ".yaml";
  for (const std::string& preset : presetNames()) {
    std::map<std::string, std::string> values = listingOf(configFromYamlFile(path, presetConfig(preset))).values;
    for (const auto& [name, before] : listingOf(presetConfig(preset)).values) {
      const bool of_hand = name.rfind("hand/", 0) == 0 || name.rfind("hand_poses/tool_", 0) == 0 ||
                           name == "hand_poses/approach_distance";
      EXPECT_TRUE(of_hand || values[name] == before) << name << " in " << path;
    }
  }
}

TEST_P(HandFile, HasARowWithItsNumbersInTheDocumentation)
{
  const std::string path = GRASP_AFFORDANCES_SOURCE_DIR "/config/hands/" + GetParam() + ".yaml";
  std::map<std::string, std::string> values = listingOf(configFromYamlFile(path, Config())).values;
  const std::string row = "| `" + GetParam() + "` | " + values["hand/capture_radius"] + " | " +
                          values["hand/finger_thickness"] + " | " + values["hand/palm_width"] + " | " +
                          values["hand/palm_depth"] + " |";
  EXPECT_NE(textOfFile(GRASP_AFFORDANCES_SOURCE_DIR "/docs/hands.md").find(row), std::string::npos) << row;
  const std::string text = textOfFile(path);
  for (const char* size : {"capture_radius", "finger_thickness", "palm_width", "palm_depth"}) {
    EXPECT_NE(text.find(std::string("  ") + size + ": "), std::string::npos) << size << " in " << path;
  }
  EXPECT_NE(text.find("# Source"), std::string::npos) << path;
}

INSTANTIATE_TEST_SUITE_P(Config, HandFile, testing::ValuesIn(handNames()),
                         [](const testing::TestParamInfo<std::string>& info) { return info.param; });

std::string messageOf(const std::string& yaml)
{
  try {
    configFromYaml(yaml, Config());
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

TEST(ConfigFromYaml, OverridesWhatItNames)
{
  const Config config = configFromYaml(
      "preset: paper\nhand: {capture_radius: 0.05}\nestimation: {estimator: pca}\nneighborhood: {kind: knn}\n",
      Config());
  EXPECT_EQ(config.preset, "paper");
  EXPECT_DOUBLE_EQ(config.hand.capture_radius, 0.05);
  EXPECT_EQ(config.estimation.estimator, Estimator::pca);
  EXPECT_EQ(config.neighborhood.kind, NeighborhoodKind::knn);
  EXPECT_FALSE(config.shell.measure_length) << "from the preset";

  const Config based = configFromYaml("hand: {finger_thickness: 0.01}", config);
  EXPECT_EQ(based.preset, "paper");
  EXPECT_DOUBLE_EQ(based.hand.capture_radius, 0.05) << "from the base";
  EXPECT_EQ(configFromYaml("", config).preset, "paper") << "an empty file changes nothing";
}

TEST(ConfigFromYaml, ReadsAnEmptyFile)
{
  EXPECT_EQ(configFromYamlFile("/dev/null", presetConfig("paper")).preset, "paper");
}

TEST(ConfigFromYaml, RefusesWithNameValueAndRange)
{
  EXPECT_EQ(messageOf("hand: {capture_radius: 7}"),
            "hand/capture_radius: 7 is outside the allowed range [0.002, 0.5] m");
  EXPECT_EQ(messageOf("estimation: {estimator: ransac}"),
            "estimation/estimator: 'ransac' is none of: taubin, pca, normals");
  EXPECT_EQ(messageOf("hand: {grip: 1}"), "hand/grip: no such parameter (its value: '1')");
  EXPECT_EQ(messageOf("hand: {capture_radius: wide}"), "hand/capture_radius: 'wide' is not a number");
  EXPECT_EQ(messageOf("sampling: {samples: 1.5}"), "sampling/samples: '1.5' is not a whole number");
  EXPECT_EQ(messageOf("sampling: {seed: -1}"), "sampling/seed: '-1' is not a whole number");
  EXPECT_EQ(messageOf("occlusion: {filter: 3}"), "occlusion/filter: '3' is not true or false");
  EXPECT_EQ(messageOf("preset: best"), "preset: 'best' is none of: localizer, paper");
  EXPECT_EQ(messageOf("[1, 2]"), "the configuration is no YAML map");
  EXPECT_NE(messageOf("hand: {capture_radius: .nan}").find("outside"), std::string::npos);
  EXPECT_NE(messageOf("a: [").find("no YAML"), std::string::npos);
  EXPECT_NE(messageOf("shell: {min_length: 0.2}").find("shell/max_length"), std::string::npos);
  EXPECT_EQ(messageOf("hand: &a {x: *a}").find("hand/x: no such parameter"), 0U) << "refers to itself";
  EXPECT_NE(messageOf("shell: {radius_step: 0.0001, length_resolution: 0.0005}\nhand: {capture_radius: 0.5}")
                .find("too fine"),
            std::string::npos);
  EXPECT_NE(messageOf("hand_poses: {approach_z: -0.001}").find("too short for a direction"), std::string::npos);
  EXPECT_EQ(messageOf("hand_poses: {approach_z: -1}"), "");
  EXPECT_THROW(configFromYamlFile("/nonexistent.yaml", Config()), ParameterError);
  EXPECT_THROW(configFromYamlFile("/", Config()), ParameterError);
}

/// What a file holds is quoted in one line, however long.
TEST(ConfigFromYaml, AnswersWithOneLine)
{
  const std::string long_word(100000, 'x'), lines = R"("first\nsecond\e[31m")";
  for (const std::string& value : {long_word, lines, std::string("[1, 2]"), "{a: " + long_word + ", b: [*]}"}) {
    for (const char* name : {"preset", "estimation/estimator", "hand/capture_radius", "sampling/samples", "unknown"}) {
      const std::string message = messageOf(name + std::string(": ") + value);
      EXPECT_FALSE(message.empty());
      EXPECT_LT(message.size(), 500U);
      EXPECT_EQ(message.find_first_of("\n\x1b"), std::string::npos) << message;
    }
    EXPECT_LT(messageOf(value + ": 1").size(), 500U);
  }
}

TEST(ConfigFromYaml, NamesThatBeginWithTheirEndAreUnknown)
{
  EXPECT_NE(messageOf("\"\\0\": 1").find("no such parameter"), std::string::npos);
}

/// Texts that would need much memory or a deep stack.
TEST(ConfigFromYaml, RefusesWhatIsTooLongOrTooDeep)
{
  EXPECT_NE(messageOf(std::string(1000001, '#')).find("longer than"), std::string::npos);
  EXPECT_EQ(messageOf(std::string(1000000, '#')), "");
  EXPECT_THROW(configFromYamlFile("/dev/zero", Config()), ParameterError);
  for (const char* opening : {"[", "{", "[{", "- ", "? ", "a: {", "[&a ", "!t ["}) {
    std::string text;
    while (text.size() < 100000) {
      text += opening;
    }
    EXPECT_NE(messageOf(text), "") << opening;
  }
}

/// Puts every number outside its range, one at a time.
class OutOfRange
{
public:
  OutOfRange(Config& config, int target) : config_(config), target_(target) {}

  template <typename T>
  void operator()(const char* name, T& value, const Range<T>& range, const char*, const char*)
  {
    if (index_++ == target_) {
      const T kept = value;
      value = range.max + std::max<T>(1, range.max);
      EXPECT_THROW(validate(config_), ParameterError) << name << " " << value;
      if (std::numeric_limits<T>::is_signed) {
        value = range.min - 1;
        EXPECT_THROW(validate(config_), ParameterError) << name << " " << value;
      }
      value = kept;
    }
  }

  template <typename T>
  void operator()(const char*, T&, const char*)
  {
  }

  int count() const { return index_; }

private:
  Config& config_;
  int target_;
  int index_ = 0;
};

TEST(Validate, ChecksEveryNumber)
{
  Config config;
  OutOfRange all(config, -1);
  visitParameters(config, all);
  ASSERT_GT(all.count(), 20);
  for (int i = 0; i < all.count(); ++i) {
    visitParameters(config, OutOfRange(config, i));
  }
  EXPECT_NO_THROW(validate(config));
}

}  // namespace
}  // namespace grasp_affordances::test
