/* file.h - files that a scene may touch: whole-file reads, long files piece by piece, the library search, checked writes.
 *
 * A scene may read below the folders of `read` and write below those of `write`, both resolved to real paths, so that
 * neither ".." nor a symbolic link leads out. Only regular files are opened: a pipe or a device would hang the reader. */
#ifndef BASE_FILE_H
#define BASE_FILE_H

#include <stdio.h>

#include "base/array.h"
#include "base/str.h"

typedef struct FileAccess {
    ARRAY(Str) read, write;                    /* real paths of folders */
} FileAccess;

typedef enum FileResult { FILE_OK, FILE_MISSING, FILE_FORBIDDEN, FILE_UNREADABLE, FILE_TOO_BIG } FileResult;

void file_allow_read(Arena *a, FileAccess *access, Str folder);        /* a folder that does not exist is left out */
void file_allow_write(Arena *a, FileAccess *access, Str folder);       /* also allows to read */

/* The whole file, followed by a zero byte. access may be NULL: everything is allowed. */
FileResult file_read(Arena *a, const FileAccess *access, Str path, Str *out);
FileResult file_check(Arena *scratch, const FileAccess *access, Str path);     /* could it be read? */
FileResult file_open_write(Arena *scratch, const FileAccess *access, Str path, bool append, FILE **out);
const char *file_result_text(FileResult result);

/* A long file is read through a window that moves over it: memory that has been used before costs the system nothing, fresh
 * memory four times what the reading does. A short one stands in the window as a whole. */
typedef struct FileFeed {
    int fd;
    char *data;                                /* the window; a zero stands behind its n bytes */
    size_t n, capacity;
    uint64_t offset, size;                     /* of the window in the file; of the file */
} FileFeed;

FileResult file_feed_open(Arena *a, Str path, FileFeed *out);
void file_feed_close(FileFeed *f);
bool file_feed_is_whole(const FileFeed *f);    /* the window reaches the end of the file */
/* The first `used` bytes go, the others move to the front and more are read behind them. False, and nothing is done, at the end. */
bool file_feed_more(FileFeed *f, size_t used);
void file_feed_seek(FileFeed *f, uint64_t offset);

Str file_folder(Str path);                     /* of "a/b.pov" "a/", of "b.pov" "" */
Str file_base_name(Str path);                  /* without the folder */
Str file_join(Arena *a, Str folder, Str name); /* name alone if it is absolute or folder is empty */
/* The entry of the file's folder that has this name but for the case of letters; empty if there is none. */
Str file_other_case(Arena *a, Str path);

#endif
