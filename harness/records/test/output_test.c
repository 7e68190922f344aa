/* Files must appear completely or not at all. */
#include <fcntl.h>
#include <gsl/gsl_test.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/records/records_impl.h"
#include "harness/records/test/folder.h"

static int readable(const char *path, int count)
{
    hsize_t size = 0;
    double last = 0;
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT),
                set = H5Dopen2(file, "ramp", H5P_DEFAULT), space = H5Dget_space(set);
    double *value = calloc((size_t)count, sizeof *value);
    if (H5Sget_simple_extent_dims(space, &size, NULL) == 1 && size == (hsize_t)count &&
        H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0)
        last = value[count - 1];
    free(value);
    H5Sclose(space);
    H5Dclose(set);
    H5Fclose(file);
    return last == count - 1;
}

static void write_record(const char *path, const char *folder, int good, const char *what)
{
    enum { COUNT = 10000 };
    static double ramp[COUNT];
    const hsize_t size = COUNT;
    for (int i = 0; i < COUNT; i++)
        ramp[i] = i;
    record_file r;
    fault f = {""};
    const int before = folder_entries(folder);
    gsl_test(record_open(&r, &f) != STATUS_OK, "opened %s", f.text);
    H5Dclose(record_values(&r, r.file, "ramp", 1, &size, ramp, "m"));
    const status outcome = record_close(&r, path, &f);
    gsl_test(good ? outcome != STATUS_OK : outcome != STATUS_FAULT || strchr(f.text, '\n') != NULL,
             "%s: %s", what, f.text);
    gsl_test_int(folder_entries(folder) - before, good, "%s: files left", what);
    gsl_test(good && !readable(path, COUNT), "%s: the file can be read", what);
}

static void write_failures(void)
{
    char folder[] = "/tmp/beamwork-output-XXXXXX", path[80], nowhere[80];
    gsl_test(mkdtemp(folder) == NULL, "a folder");
    snprintf(path, sizeof path, "%s/results", folder);
    snprintf(nowhere, sizeof nowhere, "%s/none/r.h5", folder);
    struct rlimit kept, small;
    getrlimit(RLIMIT_FSIZE, &kept);
    small = kept;
    small.rlim_cur = 1000;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    write_record(path, folder, 0, "no room");
    setrlimit(RLIMIT_FSIZE, &kept);
    write_record(nowhere, folder, 0, "no folder");
    write_record(folder, folder, 0, "a folder instead of a file");
    write_record(path, folder, 1, "room");
    output o;
    fault f;
    setrlimit(RLIMIT_FSIZE, &small);
    gsl_test(output_open(path, &o, &f) != STATUS_OK, "text opened");
    for (int i = 0; i < 10000; i++)
        fputs("0123456789", o.stream);
    gsl_test(output_close(&o, &f) != STATUS_FAULT, "no room for text: %s", f.text);
    setrlimit(RLIMIT_FSIZE, &kept);
    gsl_test_int(folder_entries(folder), 1, "the file of before is still there, and nothing else");
    unlink(path);
    rmdir(folder);
}

static void write_word(FILE *to, const void *word)
{
    fputs(word, to);
}

static void abandoned(void)
{
    const test_folder of = folder_make();
    const folder_entry done = folder_path(&of, "done"), half = folder_path(&of, "half"),
                       hdf5 = folder_path(&of, "text.h5");
    output o;
    fault f = {""};
    gsl_test(folder_write_text(done.text, "whole", &f) != STATUS_OK, "a file %s", f.text);
    gsl_test(output_open(half.text, &o, &f) != STATUS_OK, "opened %s", f.text);
    gsl_test_int(folder_entries(of.path), 2, "one complete, one not");
    output_folder folder;
    const folder_entry matrices = folder_path(&of, "matrices");
    gsl_test(output_folder_open(matrices.text, &folder, &f) != STATUS_OK ||
                 output_folder_below(&folder, "state", &f) != STATUS_OK,
             "a folder %s", f.text);
    for (int i = 0; i < 500; i++) {
        char name[32];
        snprintf(name, sizeof name, "%s%d", i % 2 ? "state/" : "", i);
        gsl_test(output_folder_file(&folder, name, write_word, "half", &f) != STATUS_OK, "%s %s",
                 name, f.text);
    }
    gsl_test_int(folder_entries(of.path), 3, "one complete, two not");
    output_abandon();
    gsl_test_int(folder_entries(of.path), 1, "the complete one");
    gsl_test(output_folder_finish(&folder, STATUS_OK, &f) != STATUS_FAULT, "it is gone, too");
    gsl_test(output_close(&o, &f) != STATUS_FAULT, "it is gone");
    gsl_test(output_open(hdf5.text, &o, &f) != STATUS_REFUSED, "no text into %s", hdf5.text);
    folder_remove(&of);
}

static void finished(void)
{
    const test_folder of = folder_make();
    const folder_entry file = folder_path(&of, "file");
    output o;
    fault f = {""};
    gsl_test(folder_write_text(file.text, "before", &f) != STATUS_OK, "a file %s", f.text);
    gsl_test(output_open(file.text, &o, &f) != STATUS_OK, "opened %s", f.text);
    fputs("half", o.stream);
    gsl_test(output_finish(&o, STATUS_REFUSED, &f) != STATUS_REFUSED ||
                 !folder_holds(file.text, "before"),
             "what was not written");
    gsl_test(output_open(file.text, &o, &f) != STATUS_OK, "opened %s", f.text);
    fputs("whole", o.stream);
    gsl_test(output_finish(&o, STATUS_OK, &f) != STATUS_OK || !folder_holds(file.text, "whole"),
             "what was written");
    gsl_test_int(folder_entries(of.path), 1, "nothing else is left");
    folder_remove(&of);
    gsl_test(output_open(NULL, &o, &f) != STATUS_OK || o.stream != stdout, "no name: %s", f.text);
    gsl_test(output_finish(&o, STATUS_REFUSED, &f) != STATUS_REFUSED || puts("still open") < 0,
             "standard output stays open");
    gsl_test(output_open(NULL, &o, &f) != STATUS_OK || output_close(&o, &f) != STATUS_OK,
             "standard output is flushed %s", f.text);
}

static void permissions(void)
{
    static const mode_t mode[] = {0600, 0640, 0664, 0755};
    const test_folder of = folder_make();
    const folder_entry fresh = folder_path(&of, "fresh"), kept = folder_path(&of, "kept");
    fault f = {""};
    const mode_t before = umask(027);
    gsl_test(folder_write_text(fresh.text, "x", &f) != STATUS_OK, "written %s", f.text);
    gsl_test_int((int)(folder_mode_of(fresh.text) & 07777), 0640, "a new file as the umask says");
    umask(077);
    for (size_t i = 0; i < sizeof mode / sizeof mode[0]; i++) {
        gsl_test(folder_write_text(kept.text, "x", &f) != STATUS_OK ||
                     chmod(kept.text, mode[i]) != 0 ||
                     folder_write_text(kept.text, "y", &f) != STATUS_OK,
                 "replaced %s", f.text);
        gsl_test_int((int)(folder_mode_of(kept.text) & 07777), (int)mode[i], "as it was");
    }
    umask(before);
    folder_remove(&of);
}

static void temporary_names(void)
{
    enum { NAMES = 50 };
    const test_folder of = folder_make();
    const folder_entry file = folder_path(&of, "file");
    output o[NAMES];
    fault f = {""};
    int same = 0, beside = 0;
    for (int i = 0; i < NAMES; i++)
        gsl_test(output_open(file.text, &o[i], &f) != STATUS_OK, "opened %s", f.text);
    for (int i = 0; i < NAMES; i++) {
        struct stat there;
        for (int k = 0; k < i; k++)
            same += strcmp(o[i].temporary, o[k].temporary) == 0;
        beside += strncmp(o[i].temporary, of.path, strlen(of.path)) == 0 &&
                  lstat(o[i].temporary, &there) == 0 && S_ISREG(there.st_mode);
    }
    gsl_test_int(same, 0, "names given twice");
    gsl_test_int(beside, NAMES, "files beside the one that is written");
    for (int i = 0; i < NAMES; i++)
        output_finish(&o[i], STATUS_FAULT, &f);
    gsl_test_int(folder_entries(of.path), 0, "discarded: nothing is left");
    folder_remove(&of);
}

static void streams(void)
{
    const test_folder of = folder_make();
    const folder_entry fifo = folder_path(&of, "fifo"), link = folder_path(&of, "link");
    const char *const stream[] = {fifo.text, link.text, "/dev/null", "/dev/full"};
    char got[20] = "";
    output o;
    fault f = {""};
    gsl_test(mkfifo(fifo.text, 0600) != 0 || symlink("fifo", link.text) != 0,
             "a pipe with a name, and a link to it");
    const int reader = open(fifo.text, O_RDONLY | O_NONBLOCK);
    gsl_test(folder_write_text(fifo.text, "one", &f) != STATUS_OK ||
                 folder_write_text(link.text, "two", &f) != STATUS_OK,
             "written %s", f.text);
    gsl_test(read(reader, got, sizeof got - 1) != 6 || strcmp(got, "onetwo") != 0, "and read: %s",
             got);
    gsl_test(folder_write_text("/dev/null", "x", &f) != STATUS_OK, "to a device %s", f.text);
    if (access("/dev/full", W_OK) == 0)
        gsl_test(folder_write_text("/dev/full", "x", &f) != STATUS_FAULT, "to a full one: %s",
                 f.text);
    for (size_t i = 0; i < sizeof stream / sizeof stream[0]; i++) {
        file_place where;
        gsl_test(output_open_whole(stream[i], &o, &f) != STATUS_REFUSED ||
                     strstr(f.text, "regular file") == NULL,
                 "%s", f.text);
        gsl_test(output_try(stream[i], OUTPUT_WHOLE_FILE, &where, &f) != STATUS_REFUSED,
                 "noticed before");
    }
    gsl_test(!S_ISFIFO(folder_mode_of(fifo.text)) || !S_ISLNK(folder_mode_of(link.text)) ||
                 !S_ISCHR(folder_mode_of("/dev/null")),
             "all are what they were");
    gsl_test_int(folder_entries(of.path), 2, "nothing else is left");
    close(reader);
    folder_remove(&of);
}

static void partial_names(void)
{
    static const char *const name[][2] = {{"/tmp/a.h5", "/tmp/a.partial.h5"},
                                          {"/tmp/a.b/c", "/tmp/a.b/c.partial"},
                                          {"/tmp/.hidden", "/tmp/.hidden.partial"},
                                          {"a.tar.gz", "a.tar.partial.gz"},
                                          {"/dev/null", "/dev/null"}};
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++) {
        char partial[PATH_MAX];
        fault f = {""};
        gsl_test(output_partial(name[i][0], partial, &f) != STATUS_OK ||
                     strcmp(partial, name[i][1]) != 0,
                 "%s: %s", name[i][0], partial);
    }
}

int main(void)
{
    write_failures();
    finished();
    abandoned();
    permissions();
    temporary_names();
    streams();
    partial_names();
    return gsl_test_summary();
}
