// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>

#include "cairn/core/checksum.h"
#include "cairn/core/error.h"
#include "cairn/core/file.h"
#include "cairn/map_files/binary_file.h"
#include "cairn/map_files/map_file.h"
#include "cairn/map_files/map_statistics.h"
#include "cairn/testing/core/temporary_folder.h"
#include "cairn/testing/map_files/scene_map.h"

namespace cairn {
namespace {

using testkit::message_for;
using testkit::scene_map;
using testkit::TemporaryFolder;

namespace fs = std::filesystem;

void replace_once(std::string& text, const std::string& old, const std::string& with) {
  const auto place = text.find(old);
  ASSERT_NE(place, std::string::npos) << old;
  text.replace(place, old.size(), with);
}

template <class Value>
void put_at(std::string& bytes, std::size_t offset, Value value) {
  ASSERT_LE(offset + sizeof(Value), bytes.size());
  std::memcpy(bytes.data() + offset, &value, sizeof(Value));
}

using Edit = std::function<void(std::string&)>;

/// Changes map.json and makes its checksum fit again.
void edit_info(const fs::path& folder, const Edit& edit) {
  std::string text = read_file(folder / "map.json");
  text.resize(text.rfind("  \"crc32\""));
  edit(text);
  write_file(folder / "map.json", text + "  \"crc32\": " + std::to_string(crc32(text)) + "\n}\n");
}

void replace_checksum(const fs::path& folder, std::uint32_t old, std::uint32_t with) {
  edit_info(folder, [&](std::string& text) {
    replace_once(text, "\": " + std::to_string(old), "\": " + std::to_string(with));
  });
}

/// Changes a binary file without its seal, and makes all checksums fit again.
void edit_binary(const fs::path& folder, const char* name, const Edit& edit) {
  std::string bytes = read_file(folder / name);
  const std::uint32_t old = stored_checksum(bytes);
  bytes.resize(sealed_bytes(bytes.size()).value());
  edit(bytes);
  BlockSeal seal;
  seal.add(bytes);
  bytes += std::move(seal).finish();
  write_file(folder / name, bytes);
  replace_checksum(folder, old, stored_checksum(bytes));
}

void edit_text(const fs::path& folder, const char* name, const Edit& edit) {
  std::string text = read_file(folder / name);
  const std::uint32_t old = crc32(text);
  edit(text);
  write_file(folder / name, text);
  replace_checksum(folder, old, crc32(text));
}

/// What is wrong though all checksums fit.
struct BadMap {
  const char* what;
  std::function<void(const fs::path&)> make;
  const char* says;
};

Edit replaced(const std::string& old, const std::string& with) {
  return [=](std::string& text) { replace_once(text, old, with); };
}

template <class Value>
Edit put(std::size_t offset, Value value) {
  return [=](std::string& bytes) { put_at(bytes, offset, value); };
}

BadMap bad_info(const char* what, const std::string& old, const std::string& with, const char* says) {
  return {what, [=](const fs::path& map) { edit_info(map, replaced(old, with)); }, says};
}

template <class Value>
BadMap bad_binary(const char* what, const char* name, std::size_t offset, Value value, const char* says) {
  return {what, [=](const fs::path& map) { edit_binary(map, name, put(offset, value)); }, says};
}

void expect_refused(const std::vector<BadMap>& cases) {
  const TemporaryFolder folder;
  for (const auto& [what, make, says] : cases) {
    write_map(folder.path() / "map", scene_map());
    make(folder.path() / "map");
    EXPECT_NE(message_for(folder.path() / "map").find(says), std::string::npos)
        << what << ": " << message_for(folder.path() / "map");
    EXPECT_THROW((void)read_map_statistics(folder.path() / "map"), InputError) << what;
  }
}

TEST(MapDamage, refuses_a_bad_correction_or_noise) {
  expect_refused({
      bad_info("a correction without rows", "\"rig\"",
               "\"right_correction\": {\"disparities_px\": [0, 0, 0]}, \"rig\"",
               "expected 'rows_px', found nothing of that name"),
      bad_info("a correction of too few terms", "\"rig\"",
               "\"right_correction\": {\"rows_px\": [1, 2, 3, 4, 5, 6], \"disparities_px\": [0, 0]}, \"rig\"",
               "expected a list of 3 numbers for 'disparities_px', found [0,0]"),
      bad_info(
          "a noise of depth of 0", "\"rig\"",
          "\"depth_noise\": {\"sigma_disparity_px\": 0, \"sigma_depth_m\": 0.01}, \"rig\"",
          "expected a 'sigma_disparity_px' above 0 and a 'sigma_depth_m' of 0 or more, found 0 and 0.01"),
      bad_info("half a noise of depth", "\"rig\"", "\"depth_noise\": {\"sigma_disparity_px\": 1}, \"rig\"",
               "expected 'sigma_depth_m', found nothing of that name"),
  });
}

TEST(MapDamage, refuses_a_bad_map_json) {
  expect_refused({
      bad_info("other format", "keyframe map", "shopping list",
               "MAP/map.json: expected the format 'cairn keyframe map', found 'cairn shopping list'"),
      bad_info("older version", "\"version\": 3", "\"version\": 2",
               "MAP/map.json: expected version 3 of the format, found version 2"),
      bad_info("version is text", "\"version\": 3", "\"version\": \"2\"",
               "expected a whole number from 0 to 4294967295 for 'version', found \"2\""),
      bad_info("no JSON", "\"rig\": {", "\"rig\": [", "MAP/map.json:5: expected JSON"),
      bad_info("no image size", "\"image\"", "\"picture\"", "expected 'image', found nothing of that name"),
      bad_info("image size below 0", "\"width\": 0", "\"width\": -1",
               "expected a width and height of 0 or more, found -1 and 0"),
      bad_info("origin off the Earth", "\"rig\"",
               "\"origin\": {\"latitude_deg\": 91, \"longitude_deg\": 0, \"height_m\": 0}, \"rig\"",
               "expected a latitude within 90 degrees and a longitude within 180, found 91 and 0"),
      bad_info("settings are no text", "\"settings\": \"\"", "\"settings\": 5", "a text for 'settings'"),
      bad_info("no rig", "\"rig\"", "\"ship\"", "expected 'rig', found nothing of that name"),
      bad_info("focal length 0", "\"fx\": 525", "\"fx\": 0",
               "expected fx, fy and baseline above 0, found 0, 520 and 0.075"),
      bad_info("focal length is text", "\"fx\": 525", "\"fx\": \"525\"",
               "expected a number for 'fx', found string"),
      bad_info("unknown descriptor", "\"AKAZE\"", "\"BRIEF\"", "expected one of the descriptors ORB, SIFT"),
      bad_info("unknown norm", "\"hamming\"", "\"l1\"", "expected the norm 'hamming' or 'l2', found 'l1'"),
      bad_info("other descriptor", "\"AKAZE\"", "\"ORB\"",
               "expected the file frames/000000.orb for keyframe 0, found 'frames/000000.akaze'"),
      bad_info("other norm", "\"hamming\"", "\"l2\"",
               "frames/000000.akaze: expected descriptors of 61 bytes with norm l2, as map.json says, found "
               "61 bytes with norm number 0"),
      bad_info("other length", "\"bytes\": 61", "\"bytes\": 32",
               "expected descriptors of 32 bytes with norm hamming"),
  });
}

TEST(MapDamage, refuses_bad_keyframes_and_counts_of_map_json) {
  expect_refused({
      bad_info("file elsewhere", "frames/000001", "../../000001",
               "expected the file frames/000001.akaze for keyframe 1, found '../../000001.akaze'"),
      bad_info("part below 0", "\"part\": 1", "\"part\": -1", "expected parts from 0 up, found -1"),
      bad_info("stamp beyond 64 bits", "\"stamp_ns\": 13", "\"stamp_ns\": 991313", "for 'stamp_ns'"),
      bad_info("other stamp", "\"stamp_ns\": 13", "\"stamp_ns\": 12",
               "MAP/poses.txt:2: expected the stamp 1205031453.359684000, as map.json says, found "
               "1305031453.359684000"),
      bad_info("other frame", "\"frame\": 10", "\"frame\": 11",
               "frames/000001.akaze: expected keyframe 1 of frame 11, found keyframe 1 of frame 10"),
      bad_info("number of keyframes", "\"counts\": {\"keyframes\": 4", "\"counts\": {\"keyframes\": 5",
               "expected 5 keyframes, as counted, found a list of 4"),
      bad_info("no keyframes", "\"keyframes\": [", "\"keyframes\": [], \"were\": [",
               "expected a list of keyframes, found none"),
      bad_info("number of features", "\"features\": 40", "\"features\": 41",
               "MAP/map.json: expected 40 features"),
      bad_info("number of landmarks", "\"landmarks\": 8", "\"landmarks\": 9",
               "MAP/Point.bin: expected 9 landmarks, as map.json says, found 8"),
      bad_info("number of sightings", "\"sightings\": ", "\"sightings\": 1", "MAP/Point.bin: expected 1"),
      bad_info("no checksum of a file", "\"Point.bin\"", "\"Pint.bin\"",
               "MAP/Point.bin: expected the file that map.json names"),
  });
}

TEST(MapDamage, refuses_bad_frames) {
  const char* name = "frames/000001.akaze";
  constexpr std::size_t kRecord = 32;
  expect_refused({
      bad_binary("older version", name, 8, 2U,
                 "frames/000001.akaze: expected version 3 of the format, found version 2"),
      bad_binary("other keyframe", name, 12, 2,
                 "expected keyframe 1 of frame 10, found keyframe 2 of frame 10"),
      bad_binary("huge count", name, 20, 0xFFFFFFFFU,
                 "expected 4294967295 records of 97 bytes, found 970 bytes"),
      bad_binary("none", name, 20, 0U, "expected 0 records of 97 bytes, found 970 bytes"),
      bad_binary("longer descriptors", name, 24, 64U,
                 "expected descriptors of 61 bytes with norm hamming, as map.json says, found 64 bytes"),
      bad_binary("other norm", name, 28, 1U, "found 61 bytes with norm number 1"),
      bad_binary("index", name, kRecord, 3U, "expected feature 0, found 3"),
      bad_binary("landmark too high", name, kRecord + 4, 8,
                 "expected a landmark below 8 or -1 for feature 0, found 8"),
      bad_binary("landmark too low", name, kRecord + 4, -2, "found -2"),
      bad_binary("landmark nowhere else", name, kRecord + 4, 1, "MAP/Point.bin: expected"),
      bad_binary("u is no number", name, kRecord + 8, NAN,
                 "expected finite values and sigmas above 0 for feature 0"),
      bad_binary("disparity below 0", name, kRecord + 16, -1.0F, "finite values"),
      bad_binary("sigma 0", name, kRecord + 20, 0.0F, "finite values"),
      bad_binary("angle is no number", name, kRecord + 32, NAN, "finite values"),
      {"swapped",
       [](const fs::path& map) {
         const std::string first = read_file(map / "frames/000000.akaze");
         write_file(map / "frames/000000.akaze", read_file(map / "frames/000001.akaze"));
         write_file(map / "frames/000001.akaze", first);
       },
       "frames/000000.akaze: expected the file that map.json names, by its CRC-32, found another"},
  });
}

TEST(MapDamage, refuses_bad_points) {
  const char* name = "Point.bin";
  constexpr std::size_t kFirst = 24;
  expect_refused({
      bad_binary("older version", name, 8, 2U, "MAP/Point.bin: expected version 3"),
      bad_binary("huge count", name, 12, 0xFFFFFFFFU,
                 "expected 8 landmarks, as map.json says, found 4294967295"),
      bad_binary("huge sightings", name, 16, ~std::uint64_t{0}, "found 18446744073709551615"),
      bad_binary("other number", name, kFirst, 1U,
                 "expected landmark 0 with sightings from 0, found landmark 1"),
      bad_binary("no sighting", name, kFirst + 4, 0U, "sightings of landmark 0, found 0"),
      bad_binary("more sightings than there are", name, kFirst + 4, 4000U,
                 "sightings of landmark 0, found 4000"),
      bad_binary("one sighting more", name, kFirst + 4, 3U, "expected landmark 1 with sightings from 3"),
      bad_binary("last has one less", name, kFirst + 7 * 112 + 4, 1U, "sightings of all landmarks"),
      bad_binary("x is no number", name, kFirst + 16, static_cast<double>(NAN),
                 "expected a finite point and a covariance for landmark 0"),
      bad_binary("variance below 0", name, kFirst + 40, -1.0, "a covariance for landmark 0"),
      bad_binary("covariance not symmetric", name, kFirst + 48, 1.0, "a covariance for landmark 0"),
      {"cut short",
       [](const fs::path& map) {
         edit_binary(map, "Point.bin", [](std::string& bytes) { bytes.pop_back(); });
       },
       "expected 8 records of 112 bytes, found 895 bytes"},
  });
}

TEST(MapDamage, refuses_bad_descriptors) {
  const char* name = "Descriptor.bin";
  expect_refused({
      bad_binary("older version", name, 8, 2U, "MAP/Descriptor.bin: expected version 3"),
      bad_binary("longer", name, 12, 64U,
                 "expected descriptors of 61 bytes with norm hamming, as map.json says, found 64"),
      bad_binary("other norm", name, 16, 1U, "found 61 bytes with norm number 1"),
      bad_binary("stride", name, 20, 88U, "expected 80 bytes a record, as map.json says, found 88"),
      bad_binary("huge count", name, 24, ~std::uint64_t{0}, "found 18446744073709551615"),
      bad_binary("keyframe too high", name, 32, 4, "expected a keyframe below 4 in row 0, found 4"),
      bad_binary("keyframe below 0", name, 32, -1, "in row 0, found -1"),
      bad_binary("feature too high", name, 36, 10,
                 "MAP/Point.bin: expected landmark 0 where keyframe 1 shows it, found it at feature 10"),
      bad_binary("feature below 0", name, 36, -1, "found it at feature -1"),
      bad_binary("another descriptor", name, 48, std::uint64_t{7},
                 "MAP/Descriptor.bin: expected in row 0 the descriptor of frames/, found another"),
  });
}

TEST(MapDamage, refuses_bad_texts) {
  const auto bad_text = [](const char* what, const char* name, const std::string& old,
                           const std::string& with, const char* says) {
    return BadMap{what, [=](const fs::path& map) { edit_text(map, name, replaced(old, with)); }, says};
  };
  expect_refused({
      bad_text("pose missing", "poses.txt", "\n1305031453.4", "\n#1305031453.4",
               "MAP/poses.txt: expected 4 poses, as map.json says, found 3"),
      bad_text("place is no number", "poses.txt", ".359684000 0", ".359684000 x",
               "MAP/poses.txt:2: expected a number for tx"),
      bad_text("too many values", "poses.txt", ".359684000 0", ".359684000 0 0",
               "MAP/poses.txt:2: expected 8 values"),
      {"another table", [](const fs::path& map) { write_file(map / "uvlist.txt", "# nothing\n"); },
       "MAP/uvlist.txt: expected contents that fit their CRC-32 in map.json"},
  });
}

}  // namespace
}  // namespace cairn
