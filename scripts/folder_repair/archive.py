# SPDX-License-Identifier: MIT
"""An archive of meshes: ZIP, and tar, which may be packed. What is in it, and how one member gets out of it.

Nothing here believes an archive: names that lead elsewhere are left out, links and devices are never made, and no more is
written than was declared.
"""

import bz2
import gzip
import lzma
import os
import stat
import tarfile
import zipfile

from .basics import INPUT, USAGE, Stop, text
from .named_files import opened_zstd

CHUNK = 1 << 20
LONGEST_HEADER = 1 << 20  # of a tar: a longer one is hostile
MOST_LINKS = 10  # from one to the next
UNPACKERS = {b"\x1f\x8b": gzip.open, b"BZh": bz2.open, b"\xfd7zXZ\0": lzma.open, b"\x28\xb5\x2f\xfd": opened_zstd}


class Lost(str):
    """Why a mesh is left out that was meant: the run has not done all."""


class Broken(Exception):
    """The archive, or what is left of it, cannot be read."""


class Member:
    """A regular file. `stamp` is all that tells it from another of this size; `place` is for its archive."""
    __slots__ = ("name", "size", "stamp", "place")

    def __init__(self, name, size, stamp, place):
        self.name, self.size, self.stamp, self.place = name, size, stamp, place


def safe_name(name):
    """The name from the top of the archive on, or None if it leads elsewhere or is none."""
    if name.startswith(b"/") or b"\0" in name or b".." in name.split(b"/"):
        return None
    name = os.path.normpath(name)
    return None if name in (b".", b"") else name


class Archive:
    """What all kinds share. members() goes through them in their order, and yields pairs of a name and a member, or the reason
    why it is left out. is_stream: they can be read in this order only."""
    is_stream = False

    def __init__(self, path):
        self.path = path
        self.file = open(path, "rb")
        self.state = self.state_now()

    def state_now(self):
        status = os.fstat(self.file.fileno())
        return status.st_size, status.st_mtime_ns

    def is_changed(self):
        """Since it was opened: another one of its name is no change, for this one is still open."""
        return self.state_now() != self.state


class ZipArchive(Archive):
    def __init__(self, path):
        super().__init__(path)
        try:
            self.zip = zipfile.ZipFile(self.file)
        except Exception as error:  # pylint: disable=broad-exception-caught  # a broken archive may raise anything
            raise Broken(str(error)) from None

    @staticmethod
    def name_of(info):
        """As bytes. What is marked as UTF-8 is that; of others those from Unix are as they were there."""
        if info.flag_bits & 0x800:
            return info.orig_filename.encode("utf-8", "surrogatepass")
        name = info.orig_filename
        if info.create_system == 3:
            return name.encode("cp437")
        return name.replace("\\", "/").encode()

    def members(self):
        for info in self.zip.infolist():
            name = self.name_of(info)
            mode = info.external_attr >> 16
            if name.endswith(b"/") or stat.S_ISDIR(mode):
                continue
            if stat.S_IFMT(mode) and not stat.S_ISREG(mode):
                yield name, "is a link" if stat.S_ISLNK(mode) else "is no regular file"
            else:
                stamp = "{}-{:02}-{:02} {:02}:{:02}:{:02}".format(*info.date_time) + f" {info.CRC:08x}"
                yield name, Member(name, info.file_size, stamp, info)

    def chunks(self, member):
        """Its bytes; Broken if they are not those that were packed."""
        try:
            with self.zip.open(member.place) as file:
                while data := file.read(CHUNK):
                    yield data
        except RuntimeError:
            raise Broken("it is encrypted") from None
        except Exception as error:  # pylint: disable=broad-exception-caught
            raise Broken(str(error) or type(error).__name__) from None


class BoundedTar(tarfile.TarFile):
    has_end = False


class BoundedTarInfo(tarfile.TarInfo):
    """Takes no header of any length into memory, goes on only, and notes whether the archive has its end."""

    @classmethod
    def fromtarfile(cls, tar):
        try:
            return super().fromtarfile(tar)
        except tarfile.EOFHeaderError:
            tar.has_end = True
            raise

    def _proc_member(self, tar):
        if self.type in (tarfile.XHDTYPE, tarfile.XGLTYPE, tarfile.SOLARIS_XHDTYPE, tarfile.GNUTYPE_LONGNAME,
                         tarfile.GNUTYPE_LONGLINK) and self.size > LONGEST_HEADER:
            raise tarfile.SubsequentHeaderError(f"a header of {self.size:,} bytes")
        start = tar.offset
        member = super()._proc_member(tar)
        if self.size < 0 or member.size < 0 or tar.offset < start:
            raise tarfile.SubsequentHeaderError("a size below zero")
        return member


def walk(tar):
    """The headers of a tar in their order; Broken where it is cut off. Keeps none of them."""
    try:
        while (info := tar.next()) is not None:
            tar.members = []
            yield info
    except Broken:
        raise
    except Exception as error:  # pylint: disable=broad-exception-caught  # of tarfile, and of what unpacks
        raise Broken(str(error) or type(error).__name__) from None
    if not tar.has_end:
        raise Broken("its end is missing")


def bytes_of_tar(name):
    return name.encode("utf-8", "surrogateescape")


def member_of(info):
    name = bytes_of_tar(info.name)
    return Member(name, info.size, f"{info.mtime:.9f}", info if info.sparse is not None else info.offset_data)


def entries_of(infos):
    """As members() yields them. A hard or symbolic link to a file in the archive is that file under another name."""
    files, links = {}, {}
    for info in infos:
        name = bytes_of_tar(info.name)
        if info.isreg():
            member = member_of(info)
            files[os.path.normpath(name)] = member
            yield name, member
        elif info.islnk() or info.issym():
            to = bytes_of_tar(info.linkname)
            links[name] = os.path.normpath(to if info.islnk() else os.path.join(os.path.dirname(name), to))
        elif not info.isdir():
            yield name, "is no regular file"
    ways = {os.path.normpath(name): to for name, to in links.items()}
    for name, to in links.items():
        for _ in range(MOST_LINKS):
            to = ways.get(to, to)
        member = files.get(to)
        yield name, Member(name, member.size, member.stamp, member.place) if member else "is a link to no file in the archive"


def read_chunks(file, size):
    while size > 0:
        try:
            data = file.read(min(CHUNK, size))
        except Exception as error:  # pylint: disable=broad-exception-caught
            raise Broken(str(error) or type(error).__name__) from None
        if not data:
            raise Broken("it is cut off")
        size -= len(data)
        yield data


class UpToDamage:
    """A file that is unpacked, of which all is read that comes before a damage; then the error."""

    def __init__(self, file):
        self.file, self.error = file, None

    def read(self, size):
        if self.error:
            raise self.error
        pieces, length = [], 0
        try:
            while length < size and (data := self.file.read1(size - length)):
                pieces.append(data)
                length += len(data)
        except Exception as error:  # pylint: disable=broad-exception-caught
            self.error = error
            if not pieces:
                raise
        return b"".join(pieces)

    def close(self):
        self.file.close()


class TarArchive(Archive):
    """One that is not packed: any member can be read."""

    def __init__(self, path):
        super().__init__(path)
        self.tar = open_tar(self.file, "r:")

    def members(self):
        yield from entries_of(walk(self.tar))

    def chunks(self, member):
        if isinstance(member.place, tarfile.TarInfo):  # with holes
            file = self.tar.extractfile(member.place)
        else:
            file = self.file
            file.seek(member.place)
        yield from read_chunks(file, member.size)


class StreamedTar(Archive):
    """One that is packed: it is read from its beginning on, and goes back there if what is behind is needed."""
    is_stream = True

    def __init__(self, path, unpacker):
        super().__init__(path)
        self.unpacker = unpacker
        self.tar = self.unpacked = None
        self.infos = iter(())
        self.rewind()

    def rewind(self):
        if self.unpacked:
            self.unpacked.close()
        self.file.seek(0)
        path = f"/proc/self/fd/{self.file.fileno()}"  # the one that was opened first
        unpacked = self.unpacker(path)
        if unpacked is None:
            raise Stop(USAGE, f"{text(self.path)} is packed with Zstandard, and there is neither Python 3.14 nor the program zstd")
        self.unpacked = UpToDamage(unpacked)
        self.tar = open_tar(self.unpacked, "r|")
        self.infos = walk(self.tar)
        self.current = None

    def members(self):
        self.rewind()
        yield from entries_of(self.each())

    def each(self):
        for info in self.infos:
            self.current = info
            yield info

    @staticmethod
    def place_of(member):
        return member.place.offset_data if isinstance(member.place, tarfile.TarInfo) else member.place

    def next_place(self):
        """Goes to the next regular file, and returns its place; None at the end."""
        for info in self.each():
            if info.isreg():
                return info.offset_data
        return None

    def current_chunks(self):
        yield from read_chunks(self.tar.extractfile(self.current), self.current.size)

    def skip(self):
        """What is left of the current file, in steps: that may take long."""
        if self.current.sparse is None:
            for _ in self.current_chunks():
                yield

    def chunks(self, member):
        """Of the current member alone, while members() is at it."""
        return self.current_chunks()


def open_tar(file, mode):
    try:
        return BoundedTar.open(fileobj=file, mode=mode, tarinfo=BoundedTarInfo, bufsize=CHUNK, encoding="utf-8", errors="surrogateescape")
    except Exception as error:  # pylint: disable=broad-exception-caught
        raise Broken(str(error) or type(error).__name__) from None


def is_old_tar(head):
    """Without a mark; its check sum fits all the same."""
    try:
        tarfile.TarInfo.frombuf(head, "utf-8", "surrogateescape")
    except tarfile.HeaderError:
        return False
    return True


def open_archive(path):
    """By what it begins with. Stop if it is none that can be read."""
    try:
        with open(path, "rb") as file:
            head = file.read(512)
        unpacker = next((unpacker for mark, unpacker in UNPACKERS.items() if head.startswith(mark)), None)
        if head.startswith(b"PK"):
            return ZipArchive(path)
        if unpacker:
            return StreamedTar(path, unpacker)
        if head[257:262] != b"ustar" and not is_old_tar(head):
            raise Stop(USAGE, f"{text(path)} is neither a folder nor an archive")
        return TarArchive(path)
    except OSError as error:
        raise Stop(INPUT, f"{text(path)}: cannot be opened: {error.strerror or error}") from None
    except Broken as error:
        raise Stop(INPUT, f"{text(path)}: is no archive that can be read: {error}") from None
