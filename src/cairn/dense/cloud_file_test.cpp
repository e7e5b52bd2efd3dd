// SPDX-License-Identifier: Apache-2.0
#include "cairn/dense/cloud_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/core/random.h"
#include "cairn/testing/core/temporary_folder.h"

namespace cairn {
namespace {

using testkit::TemporaryFolder;

Cloud random_cloud(std::size_t count) {
  Random random(count);
  Cloud cloud;
  for (std::size_t i = 0; i < count; ++i) {
    const auto coordinate = [&] { return static_cast<float>(random.uniform(-10, 10)); };
    const auto channel = [&] { return static_cast<std::uint8_t>(random.index(256)); };
    cloud.points.push_back({coordinate(), coordinate(), coordinate(), channel(), channel(), channel()});
  }
  return cloud;
}

std::string bytes_of(std::initializer_list<float> values) {
  std::string bytes;
  for (const float value : values) {
    char raw[4];
    std::memcpy(raw, &value, 4);
    bytes.append(raw, 4);
  }
  return bytes;
}

Cloud read_text(const std::string& name, const std::string& contents) {
  const TemporaryFolder folder;
  return read_cloud(folder.write(name, contents));
}

TEST(CloudFile, WrittenPointsComeBack) {
  const TemporaryFolder folder;
  for (const std::size_t count : {0U, 1U, 5000U, 10000U}) {
    const Cloud cloud = random_cloud(count);
    for (const char* name : {"a.ply", "a.pcd"}) {
      const auto path = folder / name;
      write_cloud(path, cloud);
      const Cloud read = read_cloud(path);
      EXPECT_EQ(read.points, cloud.points) << name;
      EXPECT_TRUE(read.colored);
    }
  }
}

TEST(CloudFile, TheBytesOfAPlyFile) {
  const TemporaryFolder folder;
  const auto path = folder / "bytes.ply";
  write_cloud(path, {{{1.0F, 2.0F, 3.0F, 65, 66, 67}}});
  EXPECT_EQ(read_file(path),
            "ply\nformat binary_little_endian 1.0\ncomment written by cairn, metres\nelement vertex 1\n"
            "property float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
            "property uchar blue\nend_header\n" +
                bytes_of({1, 2, 3}) + "ABC");
}

TEST(CloudFile, TheBytesOfAPcdFile) {
  const TemporaryFolder folder;
  const auto path = folder / "bytes.pcd";
  write_cloud(path, {{{1.0F, 2.0F, 3.0F, 65, 66, 67}}});
  EXPECT_EQ(
      read_file(path),
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\n"
      "TYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA binary\n" +
          bytes_of({1, 2, 3}) + std::string("CBA\0", 4));
}

TEST(CloudFile, ReadsAsciiPlyAndSkipsWhatItDoesNotKnow) {
  const Cloud cloud =
      read_text("ascii.ply",
                "ply\r\nformat ascii 1.0\r\ncomment from elsewhere\r\nelement vertex 3\r\n"
                "property double x\nproperty float nx\nproperty double y\nproperty double z\n"
                "property uchar alpha\nproperty uchar red\nproperty uchar green\n"
                "property uchar blue\nelement face 1\nproperty list uchar int vertex_indices\n"
                "end_header\n1.5 9 +2 -3e-1 255 10 20 30\n\n4 9 5 6 255 1 2 3\n"
                "nan 0 0 0 0 0 0 0\n3 0 1 2\n");
  const std::vector<CloudPoint> expected = {{1.5F, 2.0F, -0.3F, 10, 20, 30}, {4, 5, 6, 1, 2, 3}};
  EXPECT_EQ(cloud.points, expected);
  EXPECT_TRUE(cloud.colored);
}

TEST(CloudFile, ReadsBinaryPlyWithOtherTypes) {
  const Cloud cloud = read_text("binary.ply",
                                "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty short id\n"
                                "property float x\nproperty float y\nproperty float z\nend_header\n"
                                "ab" +
                                    bytes_of({1, 2, 3}) + "cd" + bytes_of({4, 5, 6}) + "trailing faces");
  const std::vector<CloudPoint> expected = {{1, 2, 3, 0, 0, 0}, {4, 5, 6, 0, 0, 0}};
  EXPECT_EQ(cloud.points, expected);
  EXPECT_FALSE(cloud.colored);
}

TEST(CloudFile, ReadsAsciiPcdWithEitherKindOfPackedColour) {
  const std::string head = "# comment\nVERSION .7\nFIELDS normal x y z rgb\nSIZE 4 4 4 4 4\n";
  const std::string tail =
      "COUNT 2 1 1 1 1\nWIDTH 1\nHEIGHT 2\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\nDATA ascii\n";
  const std::vector<CloudPoint> expected = {{1, 2, 3, 65, 66, 67}};
  const std::string second = "0 0 nan nan nan 0\n";
  EXPECT_EQ(read_text("u.pcd", head + "TYPE F F F F U\n" + tail + "7 8 1 2 3 4276803\n" + second).points,
            expected);
  // 4276803 = 0x414243, as the bits of a float: 5.99307729e-39
  EXPECT_EQ(read_text("f.pcd", head + "TYPE F F F F F\n" + tail + "7 8 1 2 3 5.993077e-39\n" + second).points,
            expected);
}

struct Broken {
  const char* name;
  const char* contents;
  const char* message;  ///< after the path
};

constexpr const char* kPlyHead =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n";

const Broken kBroken[] = {
    {"empty.ply", "",
     ":1: expected a PLY file, which begins with 'ply', found other contents.\n  Check the file."},
    {"cut.ply", "ply\nformat ascii 1.0\nelement vertex 2\n",
     ":3: expected end_header, found the end of the file.\n  The file is cut off."},
    {"big.ply", "ply\nformat binary_big_endian 1.0\n",
     ":2: expected format ascii or binary_little_endian, found 'binary_big_endian'.\n"
     "  Convert the file to binary_little_endian."},
    {"noformat.ply", "ply\nelement vertex 0\nproperty float x\nend_header\n",
     ":4: expected a format line in the header, found none.\n  Write the file again."},
    {"faces.ply", "ply\nformat ascii 1.0\nelement face 1\nend_header\n",
     ":3: expected vertices as the first element, found 'face'.\n  Write the vertices first."},
    {"negative.ply", "ply\nformat ascii 1.0\nelement vertex -4\nend_header\n",
     ":3: expected the number of vertices, found '-4'.\n  Correct the header."},
    {"type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\nend_header\n",
     ":4: expected a PLY type such as float or uchar, found 'real'.\n  Correct the header."},
    {"list.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty list uchar int x\nend_header\n",
     ": expected points with x, y and z, found none with x.\n  Choose a point cloud."},
    {"word.ply", "ply\nformat ascii 1.0\nvertices 5\nend_header\n",
     ":3: expected format, element, property, comment or end_header, found 'vertices 5'.\n"
     "  Write the file again; its header is broken."},
    {"noz.ply",
     "PLY_HEAD"
     "end_header\n1 2\n3 4\n",
     ": expected points with x, y and z, found none with z.\n  Choose a point cloud."},
    {"floatcolor.ply",
     "PLY_HEAD"
     "property float z\nproperty float red\nend_header\n",
     ": expected colours as unsigned bytes, found red as floating point of 4 bytes.\n"
     "  Convert the file, or remove its colours."},
    {"short.ply",
     "PLY_HEAD"
     "property float z\nend_header\n1 2 3\n",
     ": expected 2 points, found 1.\n  The file is cut off; write or copy it again."},
    {"text.ply",
     "PLY_HEAD"
     "property float z\nend_header\n1 2 3\n4 five 6\n",
     ":9: expected a number for y, found 'five'.\n  Correct or delete the line."},
    {"few.ply",
     "PLY_HEAD"
     "property float z\nend_header\n1 2\n4 5 6\n",
     ":8: expected 3 values, found 2.\n  Correct or delete the line."},
    {"color.ply",
     "PLY_HEAD"
     "property float z\nproperty uchar red\nend_header\n1 2 3 256\n1 1 1 1\n",
     ":9: expected a whole number from 0 to 255 for red, found '256'.\n  Correct or delete the line."},
    {"huge.ply",
     "ply\nformat binary_little_endian 1.0\nelement vertex 9000000000000000000\nproperty float x\n"
     "property float y\nproperty float z\nend_header\n12345678",
     ": expected 9000000000000000000 points of 12 bytes, found 8 bytes of points.\n"
     "  The file is cut off; write or copy it again."},
    {"hugetext.ply",
     "ply\nformat ascii 1.0\nelement vertex 9000000000000000000\nproperty float x\nproperty float y\n"
     "property float z\nend_header\n1 2 3\n",
     ": expected 9000000000000000000 points of 3 values, found 6 bytes of points.\n"
     "  The file is cut off; write or copy it again."},
    {"empty.pcd", "",
     ": expected a PCD header that ends with DATA, found the end of the file.\n"
     "  Check that this is a whole PCD file."},
    {"word.pcd", "hello world\n",
     ":1: expected a word of the PCD header, found 'hello'.\n  Check that this is a PCD file."},
    {"alone.pcd", "FIELDS\n", ":1: expected a value, found 'FIELDS' alone.\n  Correct the header."},
    {"size.pcd", "FIELDS x y z\nSIZE 4 4 3\n",
     ":2: expected a SIZE of 1, 2, 4 or 8, found '3'.\n  Correct the header."},
    {"sizes.pcd", "FIELDS x y z\nSIZE 4 4\n",
     ":2: expected SIZE with 3 values, one for each of FIELDS, found 2.\n  Correct the header."},
    {"kind.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F D\n",
     ":3: expected a TYPE of F, I or U, found 'D'.\n  Correct the header."},
    {"half.pcd", "FIELDS x y z\nSIZE 2 4 4\nTYPE F F F\n",
     ":3: expected floating point of 4 or 8 bytes, found x of 2 bytes.\n  Correct the header."},
    {"count.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 0\n",
     ":4: expected a whole number from 1 to 1000000 for COUNT, found '0'.\n  Correct the header."},
    {"points.pcd", "FIELDS x y z\nPOINTS many\n",
     ":2: expected a whole number from 0 to 1000000000000 for POINTS, found 'many'.\n  Correct the header."},
    {"nopoints.pcd", "FIELDS x y z\nDATA ascii\n1 2 3\n",
     ":2: expected POINTS or WIDTH and HEIGHT before DATA, found neither.\n  Add the line POINTS with their "
     "number."},
    {"nofields.pcd", "POINTS 1\nDATA ascii\n1 2 3\n",
     ":2: expected FIELDS before DATA, found none.\n  Write the file again; its header is broken."},
    {"compressed.pcd", "FIELDS x y z\nPOINTS 1\nDATA binary_compressed\n",
     ": expected two sizes before compressed points, found 0 bytes.\n"
     "  The file is cut off or damaged; write or copy it again."},
    {"unknown.pcd", "FIELDS x y z\nPOINTS 1\nDATA binary_zipped\n",
     ":3: expected DATA ascii, binary or binary_compressed, found 'binary_zipped'.\n"
     "  Convert the file, for example with pcl_convert_pcd_ascii_binary IN.pcd OUT.pcd 1."},
    {"packed.pcd", "FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F U\nPOINTS 1\nDATA ascii\n1 2 3 red\n",
     ":6: expected a packed colour, found 'red'.\n  Correct or delete the line."},
    {"packed8.pcd", "FIELDS x y z rgb\nSIZE 4 4 4 8\nTYPE F F F F\nPOINTS 1\nDATA ascii\n1 2 3 4\n",
     ": expected a packed colour of 4 bytes, found rgb as floating point of 8 bytes.\n  Convert the file."},
    {"cut.pcd",
     "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary\n123456789012345",
     ": expected 2 points of 12 bytes, found 15 bytes of points.\n  The file is cut off; write or copy it "
     "again."},
};

TEST(CloudFile, EveryDefectIsAnInputErrorThatSaysWhatToDo) {
  const TemporaryFolder folder;
  for (const Broken& broken : kBroken) {
    std::string contents = broken.contents;
    if (contents.starts_with("PLY_HEAD")) contents.replace(0, 8, kPlyHead);
    const auto path = folder.write(broken.name, contents);
    try {
      (void)read_cloud(path);
      ADD_FAILURE() << broken.name << " was read";
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()), path.string() + broken.message);
    }
  }
}

TEST(CloudFile, TruncatedAnywhereItIsAnInputErrorOrReadAsAWhole) {
  const TemporaryFolder folder;
  for (const char* name : {"whole.ply", "whole.pcd"}) {
    const auto whole = folder / name;
    write_cloud(whole, random_cloud(3));
    const std::string contents = read_file(whole);
    for (std::size_t length = 0; length < contents.size(); ++length)
      EXPECT_THROW((void)read_text(name, contents.substr(0, length)), InputError) << name << " " << length;
  }
}

TEST(CloudFile, extensions_may_have_capitals) {
  const testkit::TemporaryFolder folder;
  for (const char* name : {"cloud.PLY", "cloud.Pcd"}) {
    write_cloud(folder / name, Cloud{{{1.5F, -2, 3, 1, 2, 255}}});
    EXPECT_EQ(read_cloud(folder / name).points, (std::vector<CloudPoint>{{1.5F, -2, 3, 1, 2, 255}})) << name;
  }
}

TEST(CloudFile, UnknownExtension) {
  try {
    write_cloud("cloud.xyz", {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "cloud.xyz: expected a file name that ends in .ply or .pcd, found '.xyz'.\n"
                 "  Most programs read .ply; PCL's tools want .pcd.");
  }
}

}  // namespace
}  // namespace cairn
