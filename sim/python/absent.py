raise ImportError("Hedgehop was built without its Python package, because python3-dev, pybind11-dev or python3-numpy was "
                  "missing; build it in the source checkout: scripts/packages python && scripts/build hedgehop_package")
