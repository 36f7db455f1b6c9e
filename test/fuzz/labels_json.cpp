#include "evaluation/recordings.h"
#include "fuzz/check_cloud.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace grasp_affordances::fuzz
{
namespace
{

/// A folder with the recording a.pcd: four points, on the objects 0, 20, 30 and 50.
class Folder
{
public:
  Folder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "fuzz_labels_XXXXXX").string();
    require(::mkdtemp(name.data()) != nullptr, "a temporary folder can be made");
    path_ = name;
    std::ofstream(path_ / "a.pcd") << "VERSION 0.7\nFIELDS x y z label\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n"
                                      "WIDTH 4\nHEIGHT 1\nPOINTS 4\nDATA ascii\n"
                                      "0 0 1 0\n0 0.1 1 20\n0.1 0 1 30\nnan nan nan 50\n";
  }
  ~Folder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::string write(const std::uint8_t* data, std::size_t size) const
  {
    const std::string file = (path_ / "labels.json").string();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return file;
  }

private:
  std::filesystem::path path_;
};

void requireSoundLabels(const LabelledCloud& labelled)
{
  requireWholeCloud(labelled.cloud);
  require(labelled.labels.size() == labelled.cloud.size(), "every point has a label");
  require(std::isfinite(labelled.capture_radius) && labelled.capture_radius > 0.0, "the capture radius is a length");
  for (const std::uint32_t label : labelled.labels) {
    require(label <= labelled.affordances.size() || label == kDoubtful, "a label is that of an affordance");
  }
}

}  // namespace

void fuzzLabelsJson(const std::uint8_t* data, std::size_t size)
{
  static const Folder folder;
  const std::string file = folder.write(data, size);
  constexpr std::size_t kMostFrames = 4;
  try {
    std::size_t loaded = 0;
    for (const EvaluationFrame& frame : recordedFrames(file)) {
      if (++loaded > kMostFrames) {
        break;
      }
      try {
        requireSoundLabels(frame.load());
      } catch (const std::runtime_error& error) {
        requireOneLine(error.what());
      }
    }
  } catch (const std::runtime_error& error) {
    requireOneLine(error.what());
  }
}

}  // namespace grasp_affordances::fuzz
