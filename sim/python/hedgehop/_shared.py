"""Arrays in shared memory."""

import errno
import os
from multiprocessing import shared_memory

import numpy as np

FOLDER = "/dev/shm"


def _require_space(size):
    free = os.statvfs(FOLDER)
    free_bytes = free.f_bavail * free.f_frsize
    if size > free_bytes:
        raise OSError(errno.ENOSPC, f"the observations need {size / 1e6:.1f} MB of shared memory, and {FOLDER} has "
                      f"{free_bytes / 1e6:.1f} MB free; use smaller images or fewer environments, or enlarge it "
                      "(docker run --shm-size=1g)")


def _reserve(name, size):
    """Allocates the pages of a shared memory now. Otherwise, a write beyond the free space would kill the process."""
    descriptor = os.open(f"{FOLDER}/{name}", os.O_RDWR)
    try:
        os.posix_fallocate(descriptor, 0, size)
    finally:
        os.close(descriptor)


class SharedArrays:
    """Named arrays in one block of shared memory. layout  (name, shape, type) of each. name  of an existing block."""

    def __init__(self, layout, name=None):
        ends = np.cumsum([int(np.prod(shape)) * np.dtype(dtype).itemsize + 7 & ~7 for _, shape, dtype in layout])
        size = int(ends[-1])
        if name is None:
            _require_space(size)
        self._memory = shared_memory.SharedMemory(name, create=name is None, size=size)
        if name is None:
            try:
                _reserve(self._memory.name, size)
            except OSError:  # the space has been used meanwhile
                self.close(unlink=True)
                raise
        self.name = self._memory.name
        self.arrays = {key: np.ndarray(shape, dtype, self._memory.buf, int(start))
                       for (key, shape, dtype), start in zip(layout, [0, *ends[:-1]])}

    def close(self, unlink=False):
        self.arrays = {}
        self._memory.close()
        if unlink:
            self._memory.unlink()
