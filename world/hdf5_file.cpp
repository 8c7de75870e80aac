#include "world/hdf5_file.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/files/deflate.h"

namespace throng::world::hdf5 {

namespace {

constexpr hsize_t kMaxTexts = 1'000'000;
constexpr std::size_t kMaxTextLength = 1'000'000;

void require(herr_t status, const std::string& what) {
  if (status < 0) throw Failure(what);
}

Handle creation_list(hid_t list_class, const std::string& what) {
  Handle list(H5Pcreate(list_class), H5Pclose, what);
  require(H5Pset_obj_track_times(list.id(), false), what);
  return list;
}

bool same_type(const Handle& dataset, hid_t wanted, const std::string& name) {
  const Handle type(H5Dget_type(dataset.id()), H5Tclose, name);
  return H5Tequal(type.id(), wanted) > 0;
}

std::vector<hsize_t> shape_of_space(const Handle& space, const std::string& name) {
  const int rank = H5Sget_simple_extent_ndims(space.id());
  if (rank < 0) throw Failure(name);
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  require(H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr), name);
  return shape;
}

Handle open_dataset(const Handle& parent, const std::string& name) {
  return {H5Dopen2(parent.id(), name.c_str(), H5P_DEFAULT), H5Dclose, name};
}

}  // namespace

Handle::Handle(hid_t id, herr_t (*closer)(hid_t), const std::string& what)
    : id_(id), close_(closer) {
  if (id < 0) throw Failure(what);
}

Handle::Handle(Handle&& other) noexcept
    : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}

Handle& Handle::operator=(Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

Handle::~Handle() {
  if (id_ >= 0) close_(id_);
}

void Handle::close(const std::string& what) {
  if (id_ >= 0) require(close_(std::exchange(id_, H5I_INVALID_HID)), what);
}

namespace {

/// Files are closed by their handles. At the end of the program the library would try again to
/// write a file that a full disk has refused, and print that it cannot. To be called first, so
/// before main() begins.
const herr_t kEndIsLeftAlone = H5dont_atexit();  // NOLINT(cert-err58-cpp): cannot throw

}  // namespace

QuietErrors::QuietErrors() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietErrors::~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

template <>
ElementType element_type<double>() {
  return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE};
}
template <>
ElementType element_type<float>() {
  return {H5T_IEEE_F32LE, H5T_NATIVE_FLOAT};
}
template <>
ElementType element_type<std::uint64_t>() {
  return {H5T_STD_U64LE, H5T_NATIVE_UINT64};
}
template <>
ElementType element_type<std::int32_t>() {
  return {H5T_STD_I32LE, H5T_NATIVE_INT32};
}
template <>
ElementType element_type<std::uint8_t>() {
  return {H5T_STD_U8LE, H5T_NATIVE_UINT8};
}
template <>
ElementType element_type<std::int8_t>() {
  return {H5T_STD_I8LE, H5T_NATIVE_INT8};
}

Handle create_file(const std::string& path) {
  const Handle creation = creation_list(H5P_FILE_CREATE, path);
  return {H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), H5P_DEFAULT), H5Fclose, path};
}

Handle open_file(const std::string& path) {
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path};
}

Handle create_group(const Handle& parent, const std::string& name) {
  const Handle creation = creation_list(H5P_GROUP_CREATE, name);
  return {H5Gcreate2(parent.id(), name.c_str(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), H5Gclose,
          name};
}

Handle text_type(std::size_t width) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text type");
  require(H5Tset_size(type.id(), std::max<std::size_t>(width, 1)), "text type");
  require(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), "text type");
  require(H5Tset_cset(type.id(), H5T_CSET_UTF8), "text type");
  return type;
}

void write_text_attribute(const Handle& object, const std::string& name, const std::string& text) {
  const Handle type = text_type(text.size());
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose, name);
  const Handle attribute(
      H5Acreate2(object.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose, name);
  require(H5Awrite(attribute.id(), type.id(), text.c_str()), name);
}

std::string read_text_attribute(const Handle& object, const std::string& name) {
  const Handle attribute(H5Aopen(object.id(), name.c_str(), H5P_DEFAULT), H5Aclose, name);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose, name);
  const Handle space(H5Aget_space(attribute.id()), H5Sclose, name);
  const std::size_t width = H5Tget_size(type.id());
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0 ||
      H5Sget_simple_extent_npoints(space.id()) != 1 || width == 0 || width > kMaxTextLength) {
    throw Failure(name);
  }
  std::string text(width, '\0');
  require(H5Aread(attribute.id(), type.id(), text.data()), name);
  return text.substr(0, text.find('\0'));
}

RowDataset::RowDataset(const Handle& parent, std::string name, hid_t file_type, hid_t memory_type,
                       const std::vector<hsize_t>& row, hsize_t rows_per_chunk,
                       const std::string& unit)
    : name_(std::move(name)),
      memory_type_(memory_type),
      rows_per_chunk_(rows_per_chunk),
      value_bytes_(H5Tget_size(memory_type)),
      as_in_file_(H5Tequal(file_type, memory_type) > 0),
      shape_{0} {
  shape_.insert(shape_.end(), row.begin(), row.end());
  std::vector<hsize_t> largest = shape_;
  std::vector<hsize_t> chunk = shape_;
  largest[0] = H5S_UNLIMITED;
  chunk[0] = rows_per_chunk;
  for (std::size_t i = 1; i < shape_.size(); ++i) {
    if (shape_[i] > 0) continue;
    chunk[i] = 1;  // no chunk may be empty nor larger than what the dataset can become
    largest[i] = H5S_UNLIMITED;
  }
  const Handle space(
      H5Screate_simple(static_cast<int>(shape_.size()), shape_.data(), largest.data()), H5Sclose,
      name_);
  const Handle creation = creation_list(H5P_DATASET_CREATE, name_);
  require(H5Pset_chunk(creation.id(), static_cast<int>(chunk.size()), chunk.data()), name_);
  require(H5Pset_shuffle(creation.id()), name_);
  require(H5Pset_deflate(creation.id(), 1), name_);
  dataset_ = Handle(H5Dcreate2(parent.id(), name_.c_str(), file_type, space.id(), H5P_DEFAULT,
                               creation.id(), H5P_DEFAULT),
                    H5Dclose, name_);
  if (!unit.empty()) write_text_attribute(dataset_, "unit", unit);
}

bool RowDataset::is_whole_chunk(hsize_t count) const {
  const bool has_values = std::find(shape_.begin() + 1, shape_.end(), 0) == shape_.end();
  return as_in_file_ && has_values && count == rows_per_chunk_ && shape_[0] % rows_per_chunk_ == 0;
}

// Output of the dataset's filters for a chunk: all first bytes of its values, all second ones and
// so on, as one zlib stream.
void RowDataset::append_chunk(const void* data) {
  std::vector<hsize_t> start(shape_.size(), 0);
  start[0] = shape_[0];
  shape_[0] += rows_per_chunk_;
  require(H5Dset_extent(dataset_.id(), shape_.data()), name_);
  std::size_t count = rows_per_chunk_;
  for (std::size_t i = 1; i < shape_.size(); ++i) count *= shape_[i];
  const std::span bytes(static_cast<const std::uint8_t*>(data), count * value_bytes_);
  thread_local std::vector<std::uint8_t> shuffled;
  thread_local std::vector<std::uint8_t> compressed;
  shuffled.resize(bytes.size());
  for (std::size_t byte = 0; byte < value_bytes_; ++byte) {
    for (std::size_t i = 0; i < count; ++i) {
      shuffled[byte * count + i] = bytes[i * value_bytes_ + byte];
    }
  }
  const std::string_view stream = deflated(shuffled, compressed);
  constexpr std::uint32_t kNoFilterLeftOut = 0;
  require(H5Dwrite_chunk(dataset_.id(), H5P_DEFAULT, kNoFilterLeftOut, start.data(), stream.size(),
                         stream.data()),
          name_);
}

void RowDataset::append(const void* data, hsize_t count) {
  if (count == 0) return;
  if (is_whole_chunk(count)) return append_chunk(data);
  std::vector<hsize_t> start(shape_.size(), 0);
  std::vector<hsize_t> block = shape_;
  start[0] = shape_[0];
  block[0] = count;
  shape_[0] += count;
  require(H5Dset_extent(dataset_.id(), shape_.data()), name_);
  if (std::find(block.begin(), block.end(), 0) != block.end()) return;
  const Handle file_space(H5Dget_space(dataset_.id()), H5Sclose, name_);
  require(H5Sselect_hyperslab(file_space.id(), H5S_SELECT_SET, start.data(), nullptr, block.data(),
                              nullptr),
          name_);
  const Handle memory_space(H5Screate_simple(static_cast<int>(block.size()), block.data(), nullptr),
                            H5Sclose, name_);
  require(
      H5Dwrite(dataset_.id(), memory_type_, memory_space.id(), file_space.id(), H5P_DEFAULT, data),
      name_);
}

std::vector<hsize_t> dataset_shape(const Handle& parent, const std::string& name,
                                   std::size_t rank) {
  const Handle dataset = open_dataset(parent, name);
  const Handle space(H5Dget_space(dataset.id()), H5Sclose, name);
  std::vector<hsize_t> shape = shape_of_space(space, name);
  if (shape.size() != rank) throw Failure(name);
  return shape;
}

void require_stored(const Handle& parent, const std::string& name,
                    const std::vector<hsize_t>& shape, std::size_t value_bytes) {
  constexpr double kMaxDeflation = 1100;  // zlib's is 1032
  constexpr double kSmallBytes = 1e6;     // of which the partly filled last chunk is no matter
  double bytes = static_cast<double>(value_bytes);
  for (const hsize_t size : shape) bytes *= static_cast<double>(size);
  if (bytes <= kSmallBytes) return;
  const Handle dataset = open_dataset(parent, name);
  const auto stored = static_cast<double>(H5Dget_storage_size(dataset.id()));
  if (bytes > kMaxDeflation * stored) throw Failure(name);
}

void read_into(const Handle& parent, const std::string& name, const std::vector<hsize_t>& shape,
               const ElementType& type, void* data) {
  const Handle dataset = open_dataset(parent, name);
  const Handle space(H5Dget_space(dataset.id()), H5Sclose, name);
  if (shape_of_space(space, name) != shape || !same_type(dataset, type.file, name)) {
    throw Failure(name);
  }
  if (std::find(shape.begin(), shape.end(), 0) != shape.end()) return;
  require(H5Dread(dataset.id(), type.memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), name);
}

RowReader::RowReader(const Handle& parent, std::string name, const ElementType& type,
                     std::vector<hsize_t> shape)
    : name_(std::move(name)),
      memory_type_(type.memory),
      shape_(std::move(shape)),
      dataset_(open_dataset(parent, name_)) {
  const Handle space(H5Dget_space(dataset_.id()), H5Sclose, name_);
  if (shape_of_space(space, name_) != shape_ || !same_type(dataset_, type.file, name_)) {
    throw Failure(name_);
  }
}

void RowReader::read(hsize_t first, hsize_t count, void* data) const {
  if (first > shape_[0] || count > shape_[0] - first) throw Failure(name_);
  std::vector<hsize_t> start(shape_.size(), 0);
  std::vector<hsize_t> size = shape_;
  start[0] = first;
  size[0] = count;
  const Handle space(H5Dget_space(dataset_.id()), H5Sclose, name_);
  require(
      H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, size.data(), nullptr),
      name_);
  const Handle memory(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
                      H5Sclose, name_);
  require(H5Dread(dataset_.id(), memory_type_, memory.id(), space.id(), H5P_DEFAULT, data), name_);
}

void write_texts(const Handle& parent, const std::string& name,
                 const std::vector<std::string>& texts) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  std::string cells;
  for (const std::string& text : texts) {
    cells += text;
    cells.resize(cells.size() + width - text.size(), '\0');
  }
  const Handle type = text_type(width);
  RowDataset(parent, name, type.id(), type.id(), {}, 64, "").append(cells.data(), texts.size());
}

std::vector<std::string> read_texts(const Handle& parent, const std::string& name) {
  const Handle dataset = open_dataset(parent, name);
  const Handle type(H5Dget_type(dataset.id()), H5Tclose, name);
  const hsize_t count = dataset_shape(parent, name, 1)[0];
  const std::size_t width = H5Tget_size(type.id());
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0 || width == 0 ||
      width > kMaxTextLength || count > kMaxTexts) {
    throw Failure(name);
  }
  std::vector<std::string> texts;
  if (count == 0) return texts;
  require_stored(parent, name, {count}, width);
  std::string cells(count * width, '\0');
  require(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, cells.data()), name);
  for (hsize_t i = 0; i < count; ++i) {
    const std::string cell = cells.substr(i * width, width);
    texts.push_back(cell.substr(0, cell.find('\0')));
  }
  return texts;
}

}  // namespace throng::world::hdf5
