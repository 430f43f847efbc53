"""Importing this first keeps BLAS to one thread: CPU times of waiting threads are no times."""

from os import environ

environ.setdefault("OPENBLAS_NUM_THREADS", "1")
environ.setdefault("OMP_NUM_THREADS", "1")
