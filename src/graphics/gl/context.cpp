#include "graphics/gl/context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <sys/resource.h>

#include <array>
#include <cstring>
#include <utility>
#include <vector>

namespace parvis::gl {
namespace {

constexpr std::array<EGLint, 9> wanted{EGL_CONTEXT_MAJOR_VERSION,
                                       4,
                                       EGL_CONTEXT_MINOR_VERSION,
                                       5,
                                       EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
#ifdef NDEBUG
                                       EGL_NONE,
                                       EGL_NONE,
                                       EGL_NONE};
#else
                                       EGL_CONTEXT_OPENGL_DEBUG,
                                       EGL_TRUE,
                                       EGL_NONE};
#endif
constexpr std::array<EGLint, 1> whatever_there_is{EGL_NONE};
constexpr rlim_t min_address_space_bytes =
    1'200'000'000;  // Mesa's drivers map so much, and end a process that may not

bool is_software_device(EGLDeviceEXT device) {
  const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
  return extensions && std::strstr(extensions, "EGL_MESA_device_software");
}

/// Displays to try: each GPU, then Mesa without a surface.
std::vector<EGLDisplay> candidate_displays() {
  std::vector<EGLDisplay> displays;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (eglQueryDevicesEXT(EGLint(devices.size()), devices.data(), &count))
      for (EGLint i = 0; i < count; ++i)
        if (EGLDeviceEXT device = devices[std::size_t(i)]; !is_software_device(device))
          displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
  }
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    displays.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
  return displays;
}

/// Makes a context of those attributes current.
EGLContext create_context(EGLDisplay display, const EGLint* attributes) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) return EGL_NO_CONTEXT;
  if (!eglBindAPI(EGL_OPENGL_API)) return EGL_NO_CONTEXT;
  const std::array<EGLint, 5> config_attributes{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0,
                                                EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (!eglChooseConfig(display, config_attributes.data(), &config, 1, &configs) || configs == 0)
    config = nullptr;  // EGL_KHR_no_config_context: none is needed without a surface
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT) return EGL_NO_CONTEXT;
  if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) return context;
  eglDestroyContext(display, context);
  return EGL_NO_CONTEXT;
}

#ifndef NDEBUG
void GLAPIENTRY report(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message,
                       const void*) {
  if (type == GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_HIGH)
    fmt::print(stderr, "OpenGL: {}\n", message);
}
#endif

Status check_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur >= min_address_space_bytes) return Ok{};
  return error("drawing takes {} MB of address space, and this process may have {} (ulimit -v): allow more",
               min_address_space_bytes / 1'000'000, limit.rlim_cur / 1'000'000);
}

}  // namespace

Result<Context> Context::create_headless() {
  if (Status status = check_address_space(); !status) return status.errors();
  const std::vector<EGLDisplay> displays = candidate_displays();
  for (EGLDisplay display : displays) {
    EGLContext context = create_context(display, wanted.data());
    if (context == EGL_NO_CONTEXT) continue;
    Context made(display, context);
    if (Status status = check_current(); !status) return status.errors();
    return made;
  }
  for (EGLDisplay display : displays) {  // what is there instead?
    EGLContext context = create_context(display, whatever_there_is.data());
    if (context == EGL_NO_CONTEXT) continue;
    const Context found(display, context);
    if (Status status = check_current(); !status) return status.errors();
  }
  return error(
      "no OpenGL 4.5 context without a window: neither a GPU's EGL device nor Mesa's software renderer gave "
      "one; install a driver of OpenGL 4.5 or later, or libgl1-mesa-dri");
}

Context::Context(Context&& other) noexcept
    : display_(std::exchange(other.display_, nullptr)), context_(std::exchange(other.context_, nullptr)) {}

Context::~Context() {
  if (!context_) return;
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

Status check_current() {
  const int version = epoxy_gl_version();
  if (!epoxy_is_desktop_gl() || version < 45)
    return error(
        "the driver offers OpenGL {}{}.{} ({}); Parvis needs OpenGL 4.5 or later: update the driver, or "
        "install "
        "Mesa's software renderer (libgl1-mesa-dri)",
        epoxy_is_desktop_gl() ? "" : "ES ", version / 10, version % 10,
        reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
#ifndef NDEBUG
  glEnable(GL_DEBUG_OUTPUT);
  glDebugMessageCallback(report, nullptr);
#endif
  return Ok{};
}

std::string refused() {
  std::string complaints;
  constexpr std::array<std::pair<GLenum, std::string_view>, 5> names{
      {{GL_OUT_OF_MEMORY, "out of memory"},
       {GL_INVALID_VALUE, "a size or number beyond its limits"},
       {GL_INVALID_ENUM, "a format that it lacks"},
       {GL_INVALID_OPERATION, "an operation that is not possible"},
       {GL_INVALID_FRAMEBUFFER_OPERATION, "a framebuffer that is not complete"}}};
  while (const GLenum flag = glGetError())
    for (const auto& [name, text] : names)
      if (flag == name) complaints += fmt::format("{}{}", complaints.empty() ? "" : "; ", text);
  return complaints;
}

std::string driver_name() {
  return fmt::format("{}, {}", reinterpret_cast<const char*>(glGetString(GL_RENDERER)),
                     reinterpret_cast<const char*>(glGetString(GL_VERSION)));
}

bool is_software() {
  const std::string name = driver_name();
  return name.find("llvmpipe") != std::string::npos || name.find("softpipe") != std::string::npos ||
         name.find("SWR") != std::string::npos;
}

}  // namespace parvis::gl
