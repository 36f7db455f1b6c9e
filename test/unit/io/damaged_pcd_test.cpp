#include "io/pcd.h"

#include "support/allocations.h"
#include "support/pcd_files.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <string>

namespace grasp_affordances::test
{
namespace
{

/// Expects one line with `reason`, nothing on stderr, and no allocation beyond some buffers.
void expectRefused(const std::string& path, const std::string& reason)
{
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  std::string message = "nothing was thrown";
  largest_allocation = 0;
  try {
    readPcdCloud(path);
  } catch (const CloudError& error) {
    message = error.what();
  }
  const std::size_t largest = largest_allocation;
  EXPECT_EQ(testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout(), "");
  EXPECT_NE(message.find(reason), std::string::npos) << "expected '" << reason << "', got '" << message << "'";
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_LT(largest, 200000U) << reason;
}

/// As editors and other tools leave them. PCL's own reader skips empty lines only.
TEST_F(PcdTest, skipsBlankLinesBetweenPoints)
{
  Header header;
  header.data = "DATA ascii\n";
  for (const char* blank : {" ", "\t", "\r", " \t \r"}) {
    const std::string line = std::string(blank) + "\n";
    expectTwoPoints(readPcdCloud(write(header.text() + line + "1 2 3\n" + line + line + "4 5 6\n" + line)));
    expectTwoPoints(readPcdCloud(write(header.text() + "\n1 2 3\r\n" + line + "\n 4 5 6" + blank)));
  }
  expectRefused(write(header.text() + "1.0000 2 3\n \n"), "after 1 of 2 points");
}

TEST_F(PcdTest, namesUnknownLinesOfTheHeaderWhereTheFileIsMalformed)
{
  Header header;
  header.fields = "FEILDS x y z\nSIZE 4 4 4\nTYPE F F F\n";
  expectRefused(write(header.text() + kTwoPoints), "no FIELDS line; unknown keys in the header: 'FEILDS'");
  header.fields = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCUONT 1 1 1\nA\nB\nC\nD\n";
  header.points = "POINTS 3\n";
  expectRefused(write(header.text() + kTwoPoints), "is not POINTS 3; unknown keys in the header: 'CUONT', 'A', 'B'");
  header = Header();
  header.fields = "FIELDS x y z i\nSIZE 4 4 4 4\nTYPE F F F F\nCUONT 1 1 1 2\n";
  header.data = "DATA ascii\n";
  expectRefused(write(header.text() + "1 2 3 4 5\n6 7 8 9 0\n"),
                "5 values, not 4; unknown keys in the header: 'CUONT'");
  header = Header();
  header.data = "DAAT ascii\n";
  expectRefused(write(header.text() + "\n"), "without a DATA line; unknown keys in the header: 'DAAT'");
}

TEST_F(PcdTest, quotesWhatIsNoNumber)
{
  Header header;
  header.data = "DATA ascii\n";
  expectRefused(write(header.text() + "1 2 3\n4 5,5 6\n"), "point 2 of the PCD file holds '5,5', which is no number");
  expectRefused(write(header.text() + "1 2 3\n4 5 6\x1b[31m\n"), "holds '6\\x1b[31m', which is no number");
  expectRefused(write(header.text() + "1 2 3\n4 5 " + std::string(5000, 'x') + "\n"), "xxx...', which is no number");
  header.viewpoint = "VIEWPOINT 0 0 0 one 0 0 0\n";
  expectRefused(write(header.text() + "1 2 3\n4 5 6\n"), "VIEWPOINT needs finite numbers, 'one' is none");
  header = Header();
  header.points = "POINTS " + std::string(5000, '9') + "\n";
  expectRefused(write(header.text() + kTwoPoints), "999...' is no integer");
}

TEST_F(PcdTest, saysWhatAFileIsThatIsNone)
{
  expectRefused(write("ply\nformat ascii 1.0\nelement vertex 0\nend_header\n"),
                "no PCD file and no bag, but a PLY file");
  expectRefused(write("hello world\nDATA is what this text is about\n"), "no PCD file and no bag, but text");
  expectRefused(write("version https://git-lfs.github.com/spec/v1\noid sha256:0\n"), "a pointer of Git LFS");
  expectRefused(write("#ROSBAG V2.0\nDATA\n"), "no PCD file, but a bag");
  expectRefused(write("\x1f\x8b\x08\n"), "but compressed by gzip");
  expectRefused(write("\x7f"
                      "ELF\n"),
                "but a program");
  expectRefused(write(std::string("\0\1\2\n", 4)), "but binary data");
}

TEST_F(PcdTest, refusesWhatIsNoPcdFile)
{
  expectRefused(folder_ / "missing.pcd", "No such file");
  expectRefused(folder_, "is a folder");
  expectRefused("/dev/null", "no regular file");
  expectRefused(write(""), "is empty");
  expectRefused(write("\n"), "no PCD file");
  expectRefused(write("hello world\n"), "no PCD file");
  expectRefused(write(std::string(100000, '\0')), "no PCD file");
  expectRefused(write("VERSION 0.7\n" + std::string(100000, 'x')), "without a DATA line");
  const std::string whole = Header().text();
  expectRefused(write(whole.substr(0, whole.size() - 1)), "without a DATA line");
}

TEST_F(PcdTest, refusesContradictoryHeaders)
{
  const auto refuse = [this](const Header& header, const char* reason) {
    expectRefused(write(header.text() + kTwoPoints), reason);
  };
  const auto fields = [&](const char* text, const char* reason) {
    Header header;
    header.fields = text;
    refuse(header, reason);
  };
  fields("", "no FIELDS line");
  fields("FIELDS\n", "names no field");
  fields("FIELDS x y z\nSIZE 4 4\nTYPE F F F\n", "SIZE has 2 values for 3 fields");
  fields("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F F\n", "TYPE has 4 values for 3 fields");
  fields("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1\n", "COUNT has 1 values for 3 fields");
  fields("FIELDS x y z\nSIZE 8 8 8\n", "SIZE and TYPE");
  fields("FIELDS x y z\nSIZE 3 4 4\nTYPE F F F\n", "field x has SIZE 3");
  fields("FIELDS x y z\nSIZE 4 4 4\nTYPE F Q F\n", "TYPE Q");
  fields("FIELDS x y z\nSIZE 4 4 four\nTYPE F F F\n", "SIZE 'four'");
  fields("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 0\n", "COUNT '0'");
  fields("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 -1\n", "COUNT '-1'");
  fields("FIELDS x y z _\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 -12\n", "steps back over the start");
  fields("FIELDS x y z _\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 -4\n", "field z lies outside");
  fields("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nSIZE 4 4 4\n", "two lines SIZE");
  fields("FIELDS x y w\nSIZE 4 4 4\nTYPE F F F\n", "no field z");
  fields("FIELDS x y z\nSIZE 4 4 4\nTYPE F F I\n", "field z has datatype 5");

  const auto extent = [&](const char* text, const char* points, const char* reason) {
    Header header;
    header.extent = text;
    header.points = points;
    refuse(header, reason);
  };
  extent("WIDTH 3\nHEIGHT 1\n", "POINTS 2\n", "is not POINTS 2");
  extent("WIDTH 2\n", "", "no POINTS line");
  extent("WIDTH -2\nHEIGHT -1\n", "POINTS 2\n", "WIDTH '-2'");
  extent("WIDTH\n", "POINTS 2\n", "WIDTH needs one value");
  extent("WIDTH 1e1\nHEIGHT 1\n", "POINTS 10\n", "WIDTH '1e1'");
  extent("WIDTH 99999999999999999999999\nHEIGHT 1\n", "POINTS 2\n", "WIDTH '9999");
  extent("WIDTH 4294967295\nHEIGHT 4294967295\n", "POINTS 1\n", "is not POINTS 1");

  Header header;
  header.viewpoint = "VIEWPOINT 0 0 0 1\n";
  refuse(header, "VIEWPOINT");
  header.viewpoint = "VIEWPOINT 0 nan 0 1 0 0 0\n";
  refuse(header, "VIEWPOINT");
  header = Header();
  header.data = "DATA zipped\n";
  refuse(header, "DATA");
}

TEST_F(PcdTest, refusesPromisesThatTheFileDoesNotHold)
{
  const auto refuse = [this](const char* extent, const char* points, const char* data, const std::string& body,
                             const char* reason) {
    Header header;
    header.extent = extent;
    header.points = points;
    header.data = data;
    expectRefused(write(header.text() + body), reason);
  };
  const char* const kTwo = "WIDTH 2\nHEIGHT 1\n";
  const char* const kAbsurd = "WIDTH 4000000000\nHEIGHT 1\n";
  for (const char* data : {"DATA ascii\n", "DATA binary\n", "DATA binary_compressed\n"}) {
    refuse(kAbsurd, "POINTS 4000000000\n", data, kTwoPoints, "promises 4000000000 points");
    refuse("WIDTH 20000\nHEIGHT 20000\n", "POINTS 400000000\n", data, kTwoPoints, "promises 400000000 points");
  }
  refuse(kTwo, "POINTS 2\n", "DATA binary\n", kTwoPoints.substr(0, 23), "promises 2 points");
  refuse(kTwo, "POINTS 2\n", "DATA binary\n", "", "promises 2 points");
  refuse(kTwo, "POINTS 2\n", "DATA ascii\n", "1 2 3\n", "promises 2 points");
  refuse(kTwo, "POINTS 2\n", "DATA ascii\n", "1.00000000 2 3\n", "after 1 of 2 points");
  refuse(kTwo, "POINTS 2\n", "DATA ascii\n", "1 2 3\n4.0000 5\n", "point 2 of the PCD file has 2 values");
  refuse(kTwo, "POINTS 2\n", "DATA ascii\n", "1 2 3 4\n4 5 6\n", "point 1 of the PCD file has 4 values");
  refuse(kTwo, "POINTS 2\n", "DATA ascii\n", "1 2 3\n4 5 six\n", "no number");
  refuse(kTwo, "POINTS 2\n", "DATA ascii\n", "1 2 3\n4 5 6x\n", "no number");
  refuse(kTwo, "POINTS 2\n", "DATA ascii\n", "1 2 3\n4 5 0x6\n", "no number");

  const std::string good = block(kTwoPointsByField);
  const char* const kCompressed = "DATA binary_compressed\n";
  refuse(kTwo, "POINTS 2\n", kCompressed, "", "before the sizes");
  refuse(kTwo, "POINTS 2\n", kCompressed, good.substr(0, 7), "before the sizes");
  refuse(kTwo, "POINTS 2\n", kCompressed, good.substr(0, 20), "claims 25 bytes, 12 follow");
  refuse(kTwo, "POINTS 2\n", kCompressed, bytes(4000000000U) + good.substr(4), "claims 4000000000 bytes");
  refuse(kTwo, "POINTS 2\n", kCompressed, good.substr(0, 4) + bytes(4000000000U) + good.substr(8),
         "unpack to 4000000000");
  refuse(kTwo, "POINTS 2\n", kCompressed, good.substr(0, 4) + bytes(12U) + good.substr(8), "unpack to 12");
  refuse(kTwo, "POINTS 2\n", kCompressed, good.substr(0, 8) + std::string(25, '\xFF'), "corrupt");
  refuse(kTwo, "POINTS 2\n", kCompressed, bytes(1U) + bytes(24U) + good.substr(8), "corrupt");
}

TEST_F(PcdTest, refusesAbsurdPoints)
{
  Header header;
  header.fields = "FIELDS x y z w\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 4294967295\n";
  for (const char* data : {"DATA ascii\n", "DATA binary\n", "DATA binary_compressed\n"}) {
    header.data = data;
    expectRefused(write(header.text() + kTwoPoints), "promises 2 points of 34359738372 bytes");
  }
}

TEST_F(PcdTest, refusesPaddingInCompressedFiles)
{
  Header header;
  header.fields = "FIELDS x y z _\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 4\n";
  header.data = "DATA binary_compressed\n";
  expectRefused(write(header.text() + block(kTwoPointsByField)), "padding");
}

/// Whatever bytes change, a file is read or refused: no crash, no other exception, no absurd allocation.
TEST_F(PcdTest, survivesChangedBytes)
{
  std::mt19937 random(11);
  const char* const bodies[][2] = {
      {"DATA ascii\n", "1 2 3\n4 5 6\n"}, {"DATA binary\n", ""}, {"DATA binary_compressed\n", ""}};
  for (const auto& [data, text] : bodies) {
    Header header;
    header.data = data;
    const std::string body = *text != '\0'                    ? text
                             : header.data == "DATA binary\n" ? kTwoPoints
                                                              : block(kTwoPointsByField);
    const std::string good = header.text() + body;
    for (int i = 0; i < 500; ++i) {
      std::string changed = good;
      for (int k = 0; k <= i % 3; ++k) {
        changed[random() % changed.size()] = "0123456789 \n-exyzFUI_\xFF"[random() % 22];
      }
      if (i % 5 == 0) {
        changed.resize(random() % changed.size() + 1);
      }
      const std::string path = write(changed);
      largest_allocation = 0;
      try {
        const Cloud cloud = readPcdCloud(path);
        EXPECT_LE(cloud.size(), 24U);
      } catch (const CloudError&) {
      }
      EXPECT_LT(largest_allocation, 200000U) << changed;
    }
  }
}

}  // namespace
}  // namespace grasp_affordances::test
