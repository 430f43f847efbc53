"""Rows into datasets and from one to another, past what HDF5 does for any selection.

It takes longer than to write the rows of a block, of which there are many in a long motion. As all
room is allocated ahead, where a row lies in the file is known: `Room` tells, and the row is written
there. HDF5 must not hold values of these datasets meanwhile, so they are kept closed.
"""

from collections.abc import Iterator
from itertools import product
from typing import Any, NamedTuple, Self

import numpy as np
import numpy.typing as npt

from .envelope import Values

_COPIED = 4096  # rows at a time


class Room(NamedTuple):
    """Where the rows of a dataset lie in its file.

    offsets: first byte of each chunk, shape (chunks along the rows, chunks beside each other).
    height, width: rows of a chunk, and values in each of its rows.
    """

    offsets: npt.NDArray[np.int64]
    height: int
    width: int

    @classmethod
    def of(cls, data: Any) -> Self:
        """That of an h5py dataset, all of it allocated and not compressed."""
        rows, *tail = data.shape
        if data.chunks is None:
            return cls(np.array([[data.id.get_offset()]]), rows, tail[0] if tail else 1)
        height, width = data.chunks
        offsets = np.empty((-(-rows // height), -(-tail[0] // width)), np.int64)

        def note(chunk: Any) -> None:
            row, column = chunk.chunk_offset
            offsets[row // height, column // width] = chunk.byte_offset

        data.id.chunk_iter(note)
        return cls(offsets, height, width)

    def parts(self, first: int, values: Values) -> Iterator[tuple[int, Values]]:
        """Contiguous parts of rows from the first on, and the byte that each begins at."""
        flat = values.reshape(len(values), -1)
        if beyond := self.offsets.shape[1] * self.width - flat.shape[1]:
            flat = np.pad(flat, ((0, 0), (0, beyond)))  # as the last chunk is
        # The row of a chunk as one item, which is copied faster.
        row = values.itemsize * self.width
        cells = flat.view(f"V{row}")
        begin = 0
        while begin < len(cells):
            chunk, below = divmod(first + begin, self.height)
            end = min(begin + self.height - below, len(cells))
            for offset, part in zip(self.offsets[chunk], cells[begin:end].T, strict=True):
                yield int(offset) + below * row, np.ascontiguousarray(part)
            begin = end


def copy_rows(source: Any, target: Any, count: int) -> None:
    """Copy the first rows of a dataset to one of the same chunks, perhaps compressed.

    Chunks that are filled go as they are, which is many times faster; what else is in the others
    is not known.
    """
    chunks, first = target.chunks, 0
    if chunks and source.chunks == chunks and target.compression is None:
        rows, columns = count - count % chunks[0], source.shape[1] - source.shape[1] % chunks[1]
        for corner in product(range(0, rows, chunks[0]), range(0, columns, chunks[1])):
            target.id.write_direct_chunk(corner, source.id.read_direct_chunk(corner)[1])
        if columns < source.shape[1]:
            for at in range(0, rows, chunks[0]):
                beside = slice(at, at + chunks[0])
                target[beside, columns:] = source[beside, columns:]
        first = rows
    for at in range(first, count, _COPIED):
        rest = slice(at, min(at + _COPIED, count))
        target[rest] = source[rest]
