#include "render/gl/context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace throng::render {

namespace {

enum class Kind { software, gpu };

struct Candidate {
  EGLDisplay display;
  std::string name;
};

struct Opened {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  std::string description;
};

bool lists(const char* extensions, std::string_view extension) {
  if (extensions == nullptr) return false;
  std::string_view rest(extensions);
  while (!rest.empty()) {
    const std::size_t space = rest.find(' ');
    if (rest.substr(0, space) == extension) return true;
    if (space == std::string_view::npos) return false;
    rest.remove_prefix(space + 1);
  }
  return false;
}

bool can_load(const char* library) {
  // Left open on purpose: epoxy is about to open it too.
  return dlopen(library, RTLD_LAZY | RTLD_GLOBAL) != nullptr;
}

/// epoxy ends the process when a library is missing, so look before it does.
void require_libraries() {
  if (!can_load("libEGL.so.1")) {
    throw EnvironmentError(
        "cannot render: libEGL.so.1 is not installed; install libegl1 (and libgl1-mesa-dri for "
        "drawing on the CPU)");
  }
  if (!can_load("libOpenGL.so.0") && !can_load("libGL.so.1")) {
    throw EnvironmentError(
        "cannot render: neither libOpenGL.so.0 nor libGL.so.1 is installed; install libopengl0 or "
        "libgl1");
  }
}

std::vector<EGLDeviceEXT> list_devices(Kind kind, const char* client_extensions) {
  if (!lists(client_extensions, "EGL_EXT_platform_device") ||
      !(lists(client_extensions, "EGL_EXT_device_base") ||
        lists(client_extensions, "EGL_EXT_device_enumeration"))) {
    return {};
  }
  std::array<EGLDeviceEXT, 32> found{};
  EGLint count = 0;
  if (eglQueryDevicesEXT(static_cast<EGLint>(found.size()), found.data(), &count) == EGL_FALSE) {
    return {};
  }
  std::vector<EGLDeviceEXT> devices;
  for (EGLint i = 0; i < count; ++i) {
    const bool software =
        lists(eglQueryDeviceStringEXT(found[i], EGL_EXTENSIONS), "EGL_MESA_device_software");
    if (software == (kind == Kind::software)) devices.push_back(found[i]);
  }
  return devices;
}

std::vector<Candidate> list_candidates(Kind kind) {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<Candidate> candidates;
  if (kind == Kind::software && lists(extensions, "EGL_MESA_platform_surfaceless")) {
    candidates.push_back(
        {eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
         "Mesa without a surface"});
  }
  for (EGLDeviceEXT device : list_devices(kind, extensions)) {
    candidates.push_back({eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr),
                          fmt::format("EGL device {}", candidates.size())});
  }
  return candidates;
}

EGLContext create_context(EGLDisplay display) {
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return EGL_NO_CONTEXT;
  EGLConfig config = nullptr;  // EGL_NO_CONFIG_KHR
  if (!lists(eglQueryString(display, EGL_EXTENSIONS), "EGL_KHR_no_config_context")) {
    const std::array<EGLint, 5> wanted = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE,
                                          EGL_PBUFFER_BIT, EGL_NONE};
    EGLint count = 0;
    if (eglChooseConfig(display, wanted.data(), &config, 1, &count) == EGL_FALSE || count == 0) {
      return EGL_NO_CONTEXT;
    }
  }
  const std::array<EGLint, 7> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                            4,
                                            EGL_CONTEXT_MINOR_VERSION,
                                            5,
                                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                            EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

std::string gl_string(GLenum name) {
  const auto* text = glGetString(name);
  return text == nullptr ? "unknown" : reinterpret_cast<const char*>(text);
}

bool is_software_renderer(std::string_view renderer) {
  return renderer.find("llvmpipe") != std::string_view::npos ||
         renderer.find("softpipe") != std::string_view::npos ||
         renderer.find("SWR") != std::string_view::npos;
}

/// Tries one display; on failure returns no context and appends the reason. Displays belong to the
/// process and are shared by its contexts, so none is ever terminated.
Opened open(const Candidate& candidate, Kind kind, std::string& reasons) {
  const auto failed = [&](std::string_view why) {
    reasons += fmt::format("\n  {}: {} (EGL error {:#06x})", candidate.name, why, eglGetError());
    return Opened{};
  };
  if (candidate.display == EGL_NO_DISPLAY) return failed("no display");
  if (eglInitialize(candidate.display, nullptr, nullptr) == EGL_FALSE) {
    return failed("the driver does not start");
  }
  const EGLContext context = create_context(candidate.display);
  if (context == EGL_NO_CONTEXT) return failed("no OpenGL 4.5 core context");
  if (eglMakeCurrent(candidate.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE) {
    eglDestroyContext(candidate.display, context);
    return failed("the context cannot be used without a surface");
  }
  const std::string renderer = gl_string(GL_RENDERER);
  if (is_software_renderer(renderer) != (kind == Kind::software)) {
    eglMakeCurrent(candidate.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(candidate.display, context);
    return failed(fmt::format("it is {}", renderer));
  }
  return {candidate.display, context,
          fmt::format("{}, {}, {}", gl_string(GL_VENDOR), renderer, gl_string(GL_VERSION))};
}

/// The first that works, or that of this number alone.
Opened open_first(Kind kind, std::optional<std::size_t> number, std::string& reasons) {
  const std::vector<Candidate> candidates = list_candidates(kind);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (number && i != *number) continue;
    const Opened opened = open(candidates[i], kind, reasons);
    if (opened.context != EGL_NO_CONTEXT) return opened;
  }
  return {};
}

constexpr std::string_view kGpu = "gpu";

/// N of "gpu:N".
std::optional<std::size_t> number_of_gpu(std::string_view name) {
  if (name.size() <= kGpu.size() + 1 || !name.starts_with("gpu:")) return std::nullopt;
  std::size_t number = 0;
  const auto [end, error] =
      std::from_chars(name.data() + kGpu.size() + 1, name.data() + name.size(), number);
  if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return number;
}

std::string resolved_name(const std::string& device) {
  const char* variable = std::getenv("THRONG_DEVICE");
  const bool override = device == "auto" && variable != nullptr && *variable != '\0';
  const std::string name = override ? variable : device;
  if (name != "auto" && name != kGpu && name != "software" && !number_of_gpu(name)) {
    throw InputError(Problem{override ? "environment variable THRONG_DEVICE" : "device", "",
                             '"' + name + '"', R"("auto", "gpu", "gpu:N" or "software")"});
  }
  return name;
}

}  // namespace

Context::Context(const std::string& device) {
  const std::string name = resolved_name(device);
  require_libraries();
  std::string reasons;
  Opened opened;
  if (name != "software") opened = open_first(Kind::gpu, number_of_gpu(name), reasons);
  if (opened.context == EGL_NO_CONTEXT && !name.starts_with(kGpu)) {
    opened = open_first(Kind::software, std::nullopt, reasons);
  }
  if (opened.context == EGL_NO_CONTEXT) {
    throw EnvironmentError(fmt::format(
        "cannot render on device \"{}\": no OpenGL 4.5 context through EGL. For the CPU install "
        "libegl1, libegl-mesa0 and libgl1-mesa-dri; for an NVIDIA GPU install libegl1, libopengl0 "
        "and the driver's libnvidia-gl with its EGL vendor file (10_nvidia.json in "
        "/usr/share/glvnd/egl_vendor.d, or named by __EGL_VENDOR_LIBRARY_FILENAMES). Tried:{}",
        name, reasons.empty() ? " nothing, EGL lists no such device" : reasons));
  }
  display_ = opened.display;
  context_ = opened.context;
  description_ = opened.description;
  is_software_ = is_software_renderer(description_);
}

Context::~Context() {
  if (eglGetCurrentContext() == context_) {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  eglDestroyContext(display_, context_);
}

void Context::make_current() const {
  if (eglGetCurrentContext() == context_) return;
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
    throw EnvironmentError(fmt::format("the OpenGL context of {} was lost (EGL error {:#06x})",
                                       description_, eglGetError()));
  }
}

}  // namespace throng::render
