// An OpenGL 4.5 context through EGL, without a window or a surface.
#pragma once

#include <string>

namespace throng::render {

/// Owns a context and makes it current on the thread that constructs it.
class Context {
 public:
  /// `device` is "software" (Mesa on the CPU), "gpu" (the first device with a working hardware
  /// driver), "gpu:N" (only the device with index N, from 0) or "auto" ($THRONG_DEVICE if set, else
  /// a GPU if there is one, else software). Throws InputError for any other name, and
  /// EnvironmentError naming the libraries to install if no context can be created.
  explicit Context(const std::string& device);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  void make_current() const;

  /// "vendor, renderer, version" as the driver reports them.
  const std::string& description() const { return description_; }
  /// Whether the device is the CPU.
  bool is_software() const { return is_software_; }

 private:
  void* display_ = nullptr;  ///< EGLDisplay
  void* context_ = nullptr;  ///< EGLContext
  std::string description_;
  bool is_software_ = true;
};

}  // namespace throng::render
