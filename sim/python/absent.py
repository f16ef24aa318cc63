raise ImportError("Hedgehop was built without its Python package, because python3-dev or pybind11-dev was missing; "
                  "build it in the source checkout: scripts/packages python && scripts/build hedgehop_package")
