# Writes OUTPUT, a C++ file that holds the text of each of SHADERS (paths relative to ROOT).
set(text "#include \"graphics/gl/shader_files.h\"\n\nnamespace parvis::gl {\nconst ShaderFile embedded_shaders[] = {\n")
foreach(shader ${SHADERS})
  file(READ ${ROOT}/${shader} body)
  string(APPEND text "{\"${shader}\", R\"PARVIS_GLSL(${body})PARVIS_GLSL\"},\n")
endforeach()
string(APPEND text "{nullptr, nullptr}};\n}  // namespace parvis::gl\n")
file(WRITE ${OUTPUT} "${text}")
