"""What two runs must have in common: a hash of all that a result file says but times, and what of
the machine it was written on."""
import hashlib

import h5py
import numpy as np

# Attributes of the run and columns of it, by how they begin.
OF_THE_RUN = ("clock", "threads", "processor", "host", "blas", "seconds", "round_", "keep_all_",
              "dense_seconds", "dense_iteration")


def hash_of(path):
    """64 hexadecimal digits: names, types and values in the order of the names."""
    digest = hashlib.sha256()

    def add(name, value):
        if value.dtype.hasobject:
            value = np.array([str(v) for v in value.ravel()]).astype("S")
        digest.update(f"{name} {value.dtype.str} {value.shape}".encode())
        digest.update(np.ascontiguousarray(value).tobytes())

    def visit(name, item):
        for key in sorted(item.attrs):
            if not key.startswith(OF_THE_RUN):
                add(f"{name}@{key}", np.asarray(item.attrs[key]))
        if not isinstance(item, h5py.Dataset) or name.split("/")[-1].startswith(OF_THE_RUN):
            return
        value = item[()]
        for column in value.dtype.names or ():
            if not column.startswith(OF_THE_RUN):
                add(f"{name}.{column}", value[column])
        if value.dtype.names is None:
            add(name, np.asarray(value))

    with h5py.File(path) as file:
        visit("", file)
        names = []
        file.visit(names.append)
        for name in sorted(names):
            visit(name, file[name])
    return digest.hexdigest()
