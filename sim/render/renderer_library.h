#pragma once

namespace hedgehop::sim {

/// A shared library of OpenGL. It is loaded when its renderer is requested, because most programs need none, and it
/// remains loaded.
class RendererLibrary {
 public:
  /// @param file  name for the dynamic linker. @param package  Debian package of the file, for messages.
  /// Throws std::runtime_error with the reason of the dynamic linker.
  RendererLibrary(const char* file, const char* package);

  /// Sets a pointer to a function. Throws std::runtime_error if the library has no such function.
  template <class Function>
  void find(Function*& function, const char* name) const {
    function = reinterpret_cast<Function*>(address(name));
  }

 private:
  void* address(const char* name) const;

  void* handle_;
  const char* file_;
};

}  // namespace hedgehop::sim
