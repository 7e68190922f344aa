/* Where a path leads to: what is there, and whether two paths are one place. */
#ifndef BEAMWORK_PLACE_H
#define BEAMWORK_PLACE_H

#include <limits.h>
#include <sys/types.h>

#include "elements/shared/status.h"

typedef enum place_kind {
    PLACE_FREE,   /* nothing is there, its folder is */
    PLACE_FILE,   /* a regular file */
    PLACE_STREAM, /* a pipe or a device, or the file that standard output or error goes to */
    PLACE_FOLDER
} place_kind;

typedef struct file_place {
    place_kind kind;
    int descriptor;      /* 1, 2: it is our own standard output or error; -1 */
    int shared;          /* 1: several may write there (a character device) */
    char path[PATH_MAX]; /* links followed; of a stream: as given */
    dev_t device;        /* of what is there; of a free place: of its folder */
    ino_t inode;
    mode_t mode; /* permissions of what is there */
    uid_t owner;
    gid_t group;
} file_place;

/* REFUSED: an empty path. FAULT: too long, or its folder is not there. */
status place_find(const char *path, file_place *out, fault *f);
/* The same file, by device and inode; of free places: the same name in the same folder. */
int place_same(const file_place *a, const file_place *b);
/* The part of a path behind its folder. */
const char *place_leaf(const char *path);

#endif
