/* file.c - files that a scene may touch; see file.h. */
#include "base/file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void allow(Arena *a, Str folder, Str **data, uint32_t *n, uint32_t *capacity)
{
    char real[PATH_MAX];
    if (!realpath(folder.n ? str_c(a, folder) : ".", real))
        return;
    if (*n == *capacity)
        *data = array_grow(a, *data, *n, capacity, sizeof **data);
    (*data)[(*n)++] = str_copy(a, str_of(real));
}

void file_allow_read(Arena *a, FileAccess *access, Str folder)
{
    allow(a, folder, &access->read.data, &access->read.n, &access->read.capacity);
}

void file_allow_write(Arena *a, FileAccess *access, Str folder)
{
    allow(a, folder, &access->write.data, &access->write.n, &access->write.capacity);
    file_allow_read(a, access, folder);
}

static bool below(Str folder, const char *real)
{
    size_t n = folder.n;
    if (n == 1 && folder.data[0] == '/')
        return true;
    return strncmp(folder.data, real, n) == 0 && (real[n] == '/' || real[n] == 0);
}

static bool allowed(const Str *folder, uint32_t n, const char *real)
{
    for (uint32_t i = 0; i < n; i++)
        if (below(folder[i], real))
            return true;
    return false;
}

/* A zero byte inside a name would end it early for the system. */
static bool is_plain(Str path)
{
    return path.n > 0 && path.n < PATH_MAX && !memchr(path.data, 0, path.n);
}

/* An open descriptor of a regular file that may be read, or -1. */
static FileResult open_read(Arena *a, const FileAccess *access, Str path, int *out)
{
    char real[PATH_MAX];
    if (!is_plain(path) || !realpath(str_c(a, path), real))
        return FILE_MISSING;
    if (access && !allowed(access->read.data, access->read.n, real))
        return FILE_FORBIDDEN;
    int fd = open(real, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    struct stat info;
    if (fd < 0 || fstat(fd, &info) != 0 || !S_ISREG(info.st_mode)) {
        if (fd >= 0)
            close(fd);
        return fd < 0 ? FILE_UNREADABLE : FILE_MISSING;
    }
    *out = fd;
    return FILE_OK;
}

FileResult file_check(Arena *scratch, const FileAccess *access, Str path)
{
    ArenaMark mark = arena_mark(scratch);
    int fd = -1;
    FileResult result = open_read(scratch, access, path, &fd);
    if (result == FILE_OK)
        close(fd);
    arena_rewind(scratch, mark);
    return result;
}

FileResult file_read(Arena *a, const FileAccess *access, Str path, Str *out)
{
    int fd = -1;
    FileResult result = open_read(a, access, path, &fd);
    if (result != FILE_OK)
        return result;
    off_t size = lseek(fd, 0, SEEK_END);
    if (size < 0 || size >= (off_t)UINT32_MAX || (a->limit && (size_t)size + a->used >= a->limit)) {
        close(fd);                             /* arena_alloc would not return, and leave the file open */
        return FILE_TOO_BIG;
    }
    char *text = arena_alloc(a, (size_t)size + 1);
    size_t n = 0;
    while (n < (size_t)size) {
        ssize_t got = pread(fd, text + n, (size_t)size - n, (off_t)n);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        n += (size_t)got;
    }
    close(fd);
    text[n] = 0;
    *out = (Str){ text, (uint32_t)n };
    return n == (size_t)size ? FILE_OK : FILE_UNREADABLE;
}

enum { FEED_FROM = 1 << 20, FEED_WINDOW = 1 << 18 };

/* Behind the n bytes that are there. What cannot be read is the end. */
static void fill(FileFeed *f)
{
    while (f->n < f->capacity && f->offset + f->n < f->size) {
        ssize_t got = pread(f->fd, f->data + f->n, f->capacity - f->n, (off_t)(f->offset + f->n));
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            f->size = f->offset + f->n;
        else
            f->n += (size_t)got;
    }
    f->data[f->n] = 0;
}

FileResult file_feed_open(Arena *a, Str path, FileFeed *out)
{
    *out = (FileFeed){ .fd = -1 };
    FileResult result = open_read(a, NULL, path, &out->fd);
    if (result != FILE_OK)
        return result;
    off_t size = lseek(out->fd, 0, SEEK_END);
    size_t capacity = size < FEED_FROM ? (size_t)size : FEED_WINDOW;
    if (size < 0 || size >= (off_t)UINT32_MAX || (a->limit && capacity + a->used >= a->limit)) {
        file_feed_close(out);
        return FILE_TOO_BIG;
    }
    out->size = (uint64_t)size;
    out->capacity = capacity;
    out->data = arena_alloc(a, capacity + 1);
    fill(out);
    if (out->size != (uint64_t)size)
        result = FILE_UNREADABLE;
    if (result != FILE_OK || file_feed_is_whole(out))
        file_feed_close(out);
    return result;
}

void file_feed_close(FileFeed *f)
{
    if (f->fd >= 0)
        close(f->fd);
    f->fd = -1;
}

bool file_feed_is_whole(const FileFeed *f)
{
    return f->offset + f->n >= f->size;
}

bool file_feed_more(FileFeed *f, size_t used)
{
    if (file_feed_is_whole(f))
        return false;
    memmove(f->data, f->data + used, f->n - used);
    f->offset += used;
    f->n -= used;
    fill(f);
    return true;
}

void file_feed_seek(FileFeed *f, uint64_t offset)
{
    f->offset = offset;
    f->n = 0;
    fill(f);
}

/* The file need not exist, but its folder must, and must be allowed; an existing file must itself be allowed and regular. */
FileResult file_open_write(Arena *scratch, const FileAccess *access, Str path, bool append, FILE **out)
{
    char real[PATH_MAX], target[PATH_MAX];
    if (!is_plain(path))
        return FILE_MISSING;
    Str name = file_base_name(path), folder = file_folder(path);
    if (!name.n || str_is(name, ".") || str_is(name, "..") || !realpath(folder.n ? str_c(scratch, folder) : ".", real))
        return FILE_MISSING;
    if (access && !allowed(access->write.data, access->write.n, real))
        return FILE_FORBIDDEN;
    int n = snprintf(target, sizeof target, "%s/%.*s", real, STR_ARGS(name));
    if (n < 0 || (size_t)n >= sizeof target)
        return FILE_MISSING;
    /* No link is followed: one that points out of the folder would carry the text there. */
    int fd = open(target, O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | (append ? O_APPEND : 0), 0666);
    struct stat info;
    if (fd < 0)
        return errno == ELOOP ? FILE_FORBIDDEN : FILE_UNREADABLE;
    if (fstat(fd, &info) != 0 || !S_ISREG(info.st_mode) || info.st_nlink > 1 || (!append && ftruncate(fd, 0) != 0)) {
        close(fd);
        return FILE_FORBIDDEN;
    }
    *out = fdopen(fd, append ? "a" : "w");
    if (*out)
        setvbuf(*out, NULL, _IOFBF, 1 << 16);
    else
        close(fd);
    return *out ? FILE_OK : FILE_UNREADABLE;
}

const char *file_result_text(FileResult result)
{
    switch (result) {
    case FILE_OK: return "fine";
    case FILE_MISSING: return "there is no such file";
    case FILE_FORBIDDEN: return "it lies outside the folders this scene may use";
    case FILE_UNREADABLE: return "it cannot be opened";
    case FILE_TOO_BIG: return "it is too big";
    }
    return "";
}

Str file_folder(Str path)
{
    uint32_t n = path.n;
    while (n && path.data[n - 1] != '/')
        n--;
    return (Str){ path.data, n };
}

Str file_base_name(Str path)
{
    uint32_t n = file_folder(path).n;
    return n ? (Str){ path.data + n, path.n - n } : path;
}

Str file_join(Arena *a, Str folder, Str name)
{
    if (!folder.n || (name.n && name.data[0] == '/'))
        return str_copy(a, name);
    const char *between = folder.data[folder.n - 1] == '/' ? "" : "/";
    return str_format(a, "%.*s%s%.*s", STR_ARGS(folder), between, STR_ARGS(name));
}

Str file_other_case(Arena *a, Str path)
{
    Str folder = file_folder(path), name = file_base_name(path), found = { 0 };
    if (!is_plain(path))
        return found;
    DIR *d = opendir(folder.n ? str_c(a, folder) : ".");
    if (!d)
        return found;
    char entry_name[NAME_MAX + 1] = "";        /* copied out: an arena that is full must not leave the folder open */
    for (struct dirent *e; (e = readdir(d));) {
        Str entry = str_of(e->d_name);
        if (entry.n <= NAME_MAX && str_equal_nocase(entry, name) && (!entry_name[0] || strcmp(e->d_name, entry_name) < 0))
            memcpy(entry_name, e->d_name, entry.n + 1u);       /* the first by name: the same on every machine */
    }
    closedir(d);
    return entry_name[0] ? str_concat(a, folder, str_of(entry_name)) : found;
}
