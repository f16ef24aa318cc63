// A library as one built against another release: never called beyond the name of its interface.
#include <cstdlib>

extern "C" const char* hedgehop_plugin_interface() { return "modules 0"; }
extern "C" void hedgehop_plugin_rows(void*) { std::abort(); }
