/* One file for many experiments. A group must be replaced completely while other groups remain,
 * even if several runs write simultaneously or are killed. */
#include <gsl/gsl_test.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/records/records.h"
#include "harness/records/test/folder.h"
#include "harness/study/study.h"

enum { WRITERS = 6, TIMES = 10, KILLS = 60, COUNT = 20000 };

static status leave(const char *path, const char *name, double mark)
{
    static double all[COUNT];
    const hsize_t size = COUNT;
    record_file r;
    fault f = {""};
    if (record_open(&r, &f) != STATUS_OK)
        return STATUS_FAULT;
    const hid_t at = kept_group(&r, name);
    for (int i = 0; i < COUNT; i++)
        all[i] = mark;
    record_count(&r, at, "mark", (long)mark);
    if (name == NULL) {
        record_text(&r, at, "schema", "beamwork-results");
        record_count(&r, at, "schema_version", 2);
    }
    H5Dclose(record_values(&r, at, "all", 1, &size, all, NULL));
    H5Gclose(at);
    return kept_close(&r, name, path, &f);
}

static long mark_of(const char *path, const char *name)
{
    static double all[COUNT];
    char at[64];
    long mark = -1;
    snprintf(at, sizeof at, "/%s%s", name != NULL ? KEPT_GROUPS "/" : "", name != NULL ? name : "");
    const hid_t file = checksum_check(path, NULL) == STATUS_OK
                           ? H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT)
                           : -1,
                group = H5Gopen2(file, at, H5P_DEFAULT), set = H5Dopen2(group, "all", H5P_DEFAULT);
    if (set < 0 || H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, all) < 0 ||
        !table_reader_attribute_count(group, "mark", &mark))
        mark = -1;
    for (int i = 0; i < COUNT; i++)
        mark = mark >= 0 && all[i] == (double)mark ? mark : -1;
    H5Dclose(set);
    H5Gclose(group);
    H5Fclose(file);
    return mark;
}

static void replaces_its_own(const char *path)
{
    gsl_test(leave(path, "a", 1) != STATUS_OK || leave(path, "b", 2) != STATUS_OK, "two groups");
    gsl_test(mark_of(path, NULL) != -1, "the root is nobody's yet");
    gsl_test(leave(path, NULL, 3) != STATUS_OK, "the root");
    gsl_test(leave(path, "a", 4) != STATUS_OK, "again");
    gsl_test(mark_of(path, "a") != 4, "a group is replaced");
    gsl_test(mark_of(path, "b") != 2, "another stays");
    gsl_test(mark_of(path, NULL) != 3, "the root stays, attributes too");
    gsl_test(leave(path, NULL, 5) != STATUS_OK || mark_of(path, NULL) != 5 ||
                 mark_of(path, "a") != 4 || mark_of(path, "b") != 2,
             "the root is replaced, groups stay");
}

static void write_often(const char *path, const char *name)
{
    for (int i = 1; i <= TIMES; i++)
        if (leave(path, name, i) != STATUS_OK)
            _exit(1);
    _exit(0);
}

static void several_at_once(const char *path)
{
    char name[WRITERS][8];
    for (int i = 0; i < WRITERS; i++) {
        snprintf(name[i], sizeof name[i], "w%d", i);
        if (fork() == 0)
            write_often(path, i > 0 ? name[i] : NULL);
    }
    for (int i = 0; i < WRITERS; i++) {
        int state = 0;
        wait(&state);
        gsl_test_int(state, 0, "a writer among others");
    }
    for (int i = 0; i < WRITERS; i++)
        gsl_test(mark_of(path, i > 0 ? name[i] : NULL) != TIMES, "what writer %d has left", i);
    gsl_test(mark_of(path, "b") != 2, "who does not write loses nothing");
}

static void killed(const char *path)
{
    int replaced = 0;
    long before = TIMES;
    for (int i = 0; i < KILLS; i++) {
        const pid_t child = fork();
        if (child == 0)
            _exit(leave(path, "w1", 100 + i) != STATUS_OK);
        usleep((useconds_t)(i * 200));
        kill(child, SIGKILL);
        waitpid(child, NULL, 0);
        const long now = mark_of(path, "w1");
        gsl_test(now != before && now != 100 + i, "killed after %d microseconds: %ld", i * 200,
                 now);
        replaced += now != before;
        before = now;
    }
    gsl_test(replaced == KILLS, "some were killed before their end");
    gsl_test(mark_of(path, "b") != 2 || mark_of(path, NULL) != TIMES, "others stay");
    gsl_test(leave(path, "w1", 7) != STATUS_OK || mark_of(path, "w1") != 7,
             "locks of those that were killed are no hindrance");
}

static void damage(const char *path)
{
    FILE *file = fopen(path, "r+b");
    fseek(file, 5000, SEEK_SET);
    fputs("damaged", file);
    fclose(file);
}

static void refuses(const char *path)
{
    fault f = {""};
    gsl_test(kept_check(path, &f) != STATUS_OK, "a file of results");
    damage(path);
    gsl_test(kept_check(path, &f) != STATUS_REFUSED, "what is damaged would be lost");
    gsl_test(leave(path, "a", 8) != STATUS_REFUSED, "it is not replaced");
    gsl_test(strstr(f.text, "another name") == NULL, "it says what to do: %s", f.text);
    remove(path);
    gsl_test(kept_check(path, &f) != STATUS_OK, "nothing is there");
}

int main(void)
{
    const test_folder folder = folder_make();
    const folder_entry path = folder_path(&folder, "results.h5");
    replaces_its_own(path.text);
    gsl_test_int(folder_entries(folder.path), 1, "no lock is left");
    several_at_once(path.text);
    gsl_test_int(folder_entries(folder.path), 1, "nor by several");
    killed(path.text);
    refuses(path.text);
    folder_remove(&folder);
    return gsl_test_summary();
}
