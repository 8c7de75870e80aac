// The little of HDF5 that a trace needs: owned handles, extendible row datasets, attributes.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace throng::world::hdf5 {

/// An HDF5 call failed; names the part of the file. Users of this header turn it into the error
/// that fits: a file being read is the user's, a file being written is the machine's.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Owns an HDF5 id of any kind.
class Handle {
 public:
  Handle() = default;
  /// `id` is negative when the call that made it failed; `what` names it in the Failure then.
  Handle(hid_t id, herr_t (*closer)(hid_t), const std::string& what);
  ~Handle();
  Handle(Handle&& other) noexcept;
  Handle& operator=(Handle&& other) noexcept;
  hid_t id() const { return id_; }
  /// Closes now; for a file this is when its last bytes are written. Throws Failure.
  void close(const std::string& what);

 private:
  hid_t id_ = H5I_INVALID_HID;
  herr_t (*close_)(hid_t) = nullptr;
};

/// Keeps HDF5 from printing its errors while it lives (in this thread).
class QuietErrors {
 public:
  QuietErrors();
  ~QuietErrors();
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Element types as they stand in the file (little endian) and in memory.
struct ElementType {
  hid_t file;
  hid_t memory;
};
template <typename T>
ElementType element_type();
template <>
ElementType element_type<double>();
template <>
ElementType element_type<float>();
template <>
ElementType element_type<std::uint64_t>();
template <>
ElementType element_type<std::int32_t>();
template <>
ElementType element_type<std::uint8_t>();
template <>
ElementType element_type<std::int8_t>();

/// No time stamps anywhere: the same content gives the same bytes.
Handle create_file(const std::string& path);
Handle open_file(const std::string& path);
Handle create_group(const Handle& parent, const std::string& name);

void write_text_attribute(const Handle& object, const std::string& name, const std::string& text);
std::string read_text_attribute(const Handle& object, const std::string& name);

template <typename T>
void write_attribute(const Handle& object, const std::string& name, T value) {
  const ElementType type = element_type<T>();
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, name);
  const Handle attribute(
      H5Acreate2(object.id(), name.c_str(), type.file, space.id(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose, name);
  if (H5Awrite(attribute.id(), type.memory, &value) < 0) throw Failure(name);
}

template <typename T>
T read_attribute(const Handle& object, const std::string& name) {
  const Handle attribute(H5Aopen(object.id(), name.c_str(), H5P_DEFAULT), H5Aclose, name);
  const Handle space(H5Aget_space(attribute.id()), H5Sclose, name);
  T value{};
  if (H5Sget_simple_extent_npoints(space.id()) != 1 ||
      H5Aread(attribute.id(), element_type<T>().memory, &value) < 0) {
    throw Failure(name);
  }
  return value;
}

/// A dataset whose first dimension grows; chunked by `rows_per_chunk` rows, shuffled and deflated.
/// Whole chunks are compressed here, which is several times as fast as HDF5's own filters.
class RowDataset {
 public:
  /// `row` is the shape of one row, e.g. {agents, 2}.
  RowDataset(const Handle& parent, std::string name, hid_t file_type, hid_t memory_type,
             const std::vector<hsize_t>& row, hsize_t rows_per_chunk, const std::string& unit);
  /// Appends `count` rows; `data` holds them one after the other.
  void append(const void* data, hsize_t count);

 private:
  bool is_whole_chunk(hsize_t count) const;
  void append_chunk(const void* data);

  std::string name_;
  hid_t memory_type_;
  hsize_t rows_per_chunk_;
  std::size_t value_bytes_;
  bool as_in_file_;  ///< memory holds values as the file does
  std::vector<hsize_t> shape_;
  Handle dataset_;
};

/// The shape of a dataset, its rank checked. Throws Failure when it is missing or has another rank.
std::vector<hsize_t> dataset_shape(const Handle& parent, const std::string& name, std::size_t rank);

/// Throws Failure when the file holds too few bytes of a dataset for its shape: a damaged shape
/// must not decide how much memory is asked for.
void require_stored(const Handle& parent, const std::string& name,
                    const std::vector<hsize_t>& shape, std::size_t value_bytes);

/// A whole dataset of numbers, whose shape must be `shape` and whose element type in the file must
/// be T's.
void read_into(const Handle& parent, const std::string& name, const std::vector<hsize_t>& shape,
               const ElementType& type, void* data);

/// Rows of a dataset of numbers, whose shape must be `shape` and whose element type in the file
/// must be that of `type`. `parent` must outlive it.
class RowReader {
 public:
  RowReader(const Handle& parent, std::string name, const ElementType& type,
            std::vector<hsize_t> shape);
  /// `count` rows from `first` on, one after the other.
  void read(hsize_t first, hsize_t count, void* data) const;

 private:
  std::string name_;
  hid_t memory_type_;
  std::vector<hsize_t> shape_;
  Handle dataset_;
};

/// Text of a fixed width, padded with zeros; the width is in the type.
Handle text_type(std::size_t width);
void write_texts(const Handle& parent, const std::string& name,
                 const std::vector<std::string>& texts);
std::vector<std::string> read_texts(const Handle& parent, const std::string& name);

}  // namespace throng::world::hdf5
