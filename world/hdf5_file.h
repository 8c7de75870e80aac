// The part of HDF5 that a trace needs: owned handles, extendible row datasets, attributes.
// Functions throw Failure unless their comment says otherwise. Not thread-safe, like HDF5 itself.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace throng::world::hdf5 {

/// An HDF5 call failed; the message names the object in the file. Callers translate it: into an
/// InputError when they read a file, into an EnvironmentError when they write one.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Owns an HDF5 id of any kind and closes it with its closer.
class Handle {
 public:
  Handle() = default;
  /// Takes ownership of `id`. Throws Failure with `what` as its message if `id` is negative, that
  /// is, if the call that created it failed.
  Handle(hid_t id, herr_t (*closer)(hid_t), const std::string& what);
  ~Handle();
  Handle(Handle&& other) noexcept;
  Handle& operator=(Handle&& other) noexcept;
  hid_t id() const { return id_; }
  /// Closes the handle now; for a file, this call writes the last bytes. Throws Failure.
  void close(const std::string& what);

 private:
  hid_t id_ = H5I_INVALID_HID;
  herr_t (*close_)(hid_t) = nullptr;
};

/// Suppresses HDF5's error output during its lifetime, in this thread.
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

/// Types of a dataset's elements in the file (little endian) and in memory.
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

/// Creates or replaces a file. Files hold no time stamps: equal content gives equal bytes.
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
/// Whole chunks are compressed by this class, which is several times as fast as HDF5's filters.
class RowDataset {
 public:
  /// `row` is the shape of one row, e.g. {agents, 2}.
  RowDataset(const Handle& parent, std::string name, hid_t file_type, hid_t memory_type,
             const std::vector<hsize_t>& row, hsize_t rows_per_chunk, const std::string& unit);
  /// Appends `count` rows; `data` holds them consecutively.
  void append(const void* data, hsize_t count);

 private:
  bool is_whole_chunk(hsize_t count) const;
  void append_chunk(const void* data);

  std::string name_;
  hid_t memory_type_;
  hsize_t rows_per_chunk_;
  std::size_t value_bytes_;
  bool as_in_file_;  ///< whether values have the same representation in memory and in the file
  std::vector<hsize_t> shape_;
  Handle dataset_;
};

/// Returns the shape of a dataset. Throws Failure if it is missing or its rank is not `rank`.
std::vector<hsize_t> dataset_shape(const Handle& parent, const std::string& name, std::size_t rank);

/// Throws Failure if a dataset occupies too few bytes in the file for its shape, so that a damaged
/// shape cannot cause a huge allocation.
void require_stored(const Handle& parent, const std::string& name,
                    const std::vector<hsize_t>& shape, std::size_t value_bytes);

/// Reads a whole dataset of numbers into `data`. Throws Failure unless its shape is `shape` and its
/// element type in the file is `type.file`.
void read_into(const Handle& parent, const std::string& name, const std::vector<hsize_t>& shape,
               const ElementType& type, void* data);

/// Reads rows of a dataset of numbers. Throws Failure unless the shape of the dataset is `shape`
/// and its element type in the file is `type.file`.
class RowReader {
 public:
  RowReader(const Handle& parent, std::string name, const ElementType& type,
            std::vector<hsize_t> shape);
  /// Reads `count` rows from index `first` on into `data`, consecutively.
  void read(hsize_t first, hsize_t count, void* data) const;

 private:
  std::string name_;
  hid_t memory_type_;
  std::vector<hsize_t> shape_;
  Handle dataset_;
};

/// Returns a text type of fixed width in bytes, padded with zeros.
Handle text_type(std::size_t width);
/// Writes texts as a dataset of one dimension; the longest text determines the width.
void write_texts(const Handle& parent, const std::string& name,
                 const std::vector<std::string>& texts);
/// Reads the texts of a dataset. Throws Failure for more than a million texts or bytes per text.
std::vector<std::string> read_texts(const Handle& parent, const std::string& name);

}  // namespace throng::world::hdf5
