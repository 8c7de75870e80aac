// HDF5 of the Pedestrian Dynamics Data Archive of Jülich.
#include <fmt/core.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "base/error.h"
#include "base/files/read_only_file.h"
#include "metrics/trajectories/comment_units.h"
#include "metrics/trajectories/other_formats.h"
#include "metrics/trajectories/text_encoding.h"
#include "metrics/trajectories/unit_words.h"
#include "world/hdf5_file.h"

namespace throng::metrics {

namespace hdf5 = world::hdf5;

namespace {

constexpr const char* kDataset = "trajectory";
constexpr hsize_t kMaxRows = 100'000'000;
constexpr double kMaxRowNumber = 1e15;

struct Row {
  double id = 0;
  double frame = 0;
  double x = 0;
  double y = 0;
};

/// Whether a type is a usual number: HDF5 converts damaged others beyond its buffers.
bool is_usual_number(hid_t type) {
  for (const hid_t usual :
       {H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_STD_I64LE, H5T_STD_I32LE, H5T_STD_I16LE, H5T_STD_U64LE,
        H5T_STD_U32LE, H5T_STD_U16LE, H5T_STD_U8LE, H5T_STD_I8LE, H5T_IEEE_F64BE, H5T_IEEE_F32BE,
        H5T_STD_I64BE, H5T_STD_I32BE}) {
    if (H5Tequal(type, usual) > 0) return true;
  }
  return false;
}

/// Whether the type has a number of this name.
bool has_number(const hdf5::Handle& type, const char* member) {
  const int index = H5Tget_member_index(type.id(), member);
  if (index < 0) return false;
  const hdf5::Handle number(H5Tget_member_type(type.id(), static_cast<unsigned>(index)), H5Tclose,
                            member);
  return is_usual_number(number.id());
}

hdf5::Handle row_type() {
  hdf5::Handle type(H5Tcreate(H5T_COMPOUND, sizeof(Row)), H5Tclose, kDataset);
  H5Tinsert(type.id(), "id", offsetof(Row, id), H5T_NATIVE_DOUBLE);
  H5Tinsert(type.id(), "frame", offsetof(Row, frame), H5T_NATIVE_DOUBLE);
  H5Tinsert(type.id(), "x", offsetof(Row, x), H5T_NATIVE_DOUBLE);
  H5Tinsert(type.id(), "y", offsetof(Row, y), H5T_NATIVE_DOUBLE);
  return type;
}

/// A number of any type in an attribute of one value; nothing if there is none.
std::optional<double> number_attribute(const hdf5::Handle& object, const char* name) {
  if (H5Aexists(object.id(), name) <= 0) return std::nullopt;
  const hdf5::Handle attribute(H5Aopen(object.id(), name, H5P_DEFAULT), H5Aclose, name);
  const hdf5::Handle space(H5Aget_space(attribute.id()), H5Sclose, name);
  const hdf5::Handle type(H5Aget_type(attribute.id()), H5Tclose, name);
  double value = 0;
  if (!is_usual_number(type.id()) || H5Sget_simple_extent_npoints(space.id()) != 1 ||
      H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, &value) < 0) {
    return std::nullopt;
  }
  return value;
}

/// A text of variable or fixed length in an attribute; empty if there is none.
std::string text_attribute(const hdf5::Handle& object, const char* name) {
  if (H5Aexists(object.id(), name) <= 0) return "";
  const hdf5::Handle attribute(H5Aopen(object.id(), name, H5P_DEFAULT), H5Aclose, name);
  const hdf5::Handle type(H5Aget_type(attribute.id()), H5Tclose, name);
  const hdf5::Handle space(H5Aget_space(attribute.id()), H5Sclose, name);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Sget_simple_extent_npoints(space.id()) != 1) {
    return "";
  }
  if (H5Tis_variable_str(type.id()) > 0) {
    char* text = nullptr;
    if (H5Aread(attribute.id(), type.id(), static_cast<void*>(&text)) < 0 || text == nullptr) {
      return "";
    }
    std::string copy(text);
    H5free_memory(text);
    return copy;
  }
  std::vector<char> text(H5Tget_size(type.id()) + 1, '\0');
  if (H5Aread(attribute.id(), type.id(), text.data()) < 0) return "";
  return text.data();
}

std::vector<Row> read_rows(const hdf5::Handle& dataset, const std::string& name) {
  const hdf5::Handle type(H5Dget_type(dataset.id()), H5Tclose, kDataset);
  for (const char* member : {"id", "frame", "x", "y"}) {
    if (H5Tget_class(type.id()) != H5T_COMPOUND || !has_number(type, member)) {
      throw InputError({name, "dataset trajectory", fmt::format("no column \"{}\"", member),
                        "columns id, frame, x and y"});
    }
  }
  const hdf5::Handle space(H5Dget_space(dataset.id()), H5Sclose, kDataset);
  const hssize_t count = H5Sget_simple_extent_npoints(space.id());
  if (count < 0 || static_cast<hsize_t>(count) > kMaxRows) {
    throw InputError({name, "dataset trajectory", fmt::format("{} rows", count),
                      fmt::format("at most {}", kMaxRows)});
  }
  // Before memory is taken, so that a damaged shape cannot exhaust it.
  const hsize_t stored = H5Dget_storage_size(dataset.id());
  constexpr hsize_t kMaxCompression = 1000;
  if (static_cast<hsize_t>(count) > (stored + 1) * kMaxCompression) {
    throw InputError({name, "dataset trajectory", fmt::format("{} rows in {} bytes", count, stored),
                      "a file that is complete"});
  }
  std::vector<Row> rows(static_cast<std::size_t>(count));
  if (H5Dread(dataset.id(), row_type().id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()) < 0) {
    throw hdf5::Failure(kDataset);
  }
  return rows;
}

Recorded read(const std::filesystem::path& file, std::optional<double> frames_per_s,
              std::optional<double> unit_m) {
  const std::string name = file.string();
  const hdf5::Handle root = hdf5::open_file(name);
  if (H5Lexists(root.id(), kDataset, H5P_DEFAULT) <= 0) {
    throw InputError({name, "", "HDF5 without a dataset \"trajectory\"",
                      "trajectories of the Pedestrian Dynamics Data Archive; a trace of throng is "
                      "given without --trajectory"});
  }
  const hdf5::Handle dataset(H5Dopen2(root.id(), kDataset, H5P_DEFAULT), H5Dclose, kDataset);
  Recorded recorded;
  recorded.frames_per_s =
      frames_per_s ? *frames_per_s : number_attribute(dataset, "fps").value_or(0);
  if (!(recorded.frames_per_s > 0)) {
    throw InputError({name, "dataset trajectory", "no attribute \"fps\"", kFrameRateExpected});
  }
  const auto unit_of = [&](const char* axis) {
    const std::string text = text_attribute(dataset, axis);
    auto unit = last_unit_in(text);
    if (!unit) unit = unit_in_comment(text);
    if (unit && unit->kind != Unit::Kind::length && !unit_m) {
      throw InputError({name, fmt::format("dataset trajectory, attribute {}", axis),
                        fmt::format("positions in {}", shown(unit->word)), expected_unit(*unit)});
    }
    return unit;
  };
  auto x = unit_of("x");
  auto y = unit_of("y");
  if (!x) x = y;
  if (!y) y = x;
  double y_scale = 1;
  if (x && !unit_m) {
    recorded.unit_m = x->factor;
    recorded.unit_is_stated = true;
    y_scale = y->factor / x->factor;
  }
  std::size_t number = 0;
  for (const Row& row : read_rows(dataset, name)) {
    ++number;
    const bool is_sound = row.id == std::floor(row.id) && row.frame == std::floor(row.frame) &&
                          std::abs(row.id) < kMaxRowNumber && std::abs(row.frame) < kMaxRowNumber &&
                          std::isfinite(row.x) && std::isfinite(row.y);
    if (!is_sound || !recorded.places[std::llround(row.id)]
                          .try_emplace(std::llround(row.frame), row.x, y_scale * row.y)
                          .second) {
      throw InputError(
          {name, fmt::format("dataset trajectory, row {}", number),
           fmt::format("person {:g}, frame {:g}, ({:g}, {:g})", row.id, row.frame, row.x, row.y),
           "finite numbers, each person once a frame"});
    }
  }
  return recorded;
}

}  // namespace

Recorded read_archive_hdf5(const std::filesystem::path& file, std::optional<double> frames_per_s,
                           std::optional<double> unit_m) {
  static_cast<void>(ReadOnlyFile(file));  // HDF5 does not say why it cannot open a file
  const hdf5::QuietErrors quiet;
  try {
    return read(file, frames_per_s, unit_m);
  } catch (const hdf5::Failure&) {
    throw InputError({file.string(), "", "HDF5 that is damaged or cut short",
                      "trajectories of the Pedestrian Dynamics Data Archive"});
  }
}

}  // namespace throng::metrics
