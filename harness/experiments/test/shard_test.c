/* Shards that are computed into folders and merged must give the same results as one process. */
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "elements/test/kit.h"
#include "harness/experiments/test/number_work.h"

static void one_folder(void)
{
    const test_folder of = folder_make();
    const char *const folder[] = {of.path};
    numbers_work w;
    shard_outcome done;
    fault f = {""};
    batch_store s;
    char text[200];
    numbers_begin(&w);
    for (int k = 2; k >= 0; k--) {
        gsl_test(numbers_merge(&w, folder, 1, &s, &f) != STATUS_OK, "what is there: %s", f.text);
        batch_store_missing(&s, &w.w, text, sizeof text);
        gsl_test(strstr(text, "of 40 batches are missing: ") == NULL, "%s", text);
        gsl_test(k == 0 && strstr(text, "(shards 1/3)") == NULL, "whose they are: %s", text);
        batch_store_free(&s);
        gsl_test(numbers_shard(&w, of.path, k, 3, &done, &f) != STATUS_OK, "%s", f.text);
        gsl_test(done.done != done.mine || done.mine < 10, "its batches: %d", done.mine);
    }
    numbers_are_whole(&w, folder, 1, "three shards in one folder");
    gsl_test(numbers_shard(&w, of.path, 0, 1, &done, &f) != STATUS_OK, "%s", f.text);
    gsl_test(done.done != 0 || done.before != NUMBERS_BATCHES, "nothing is done twice");
    gsl_test_int(folder_entries(of.path), NUMBERS_BATCHES, "and nothing else is left");
    folder_remove(&of);
}

static void two_folders(void)
{
    const test_folder a = folder_make(), b = folder_make();
    const char *const folder[] = {a.path, b.path};
    numbers_work w;
    shard_outcome done;
    fault f = {""};
    batch_store s;
    numbers_begin(&w);
    gsl_test(numbers_shard(&w, a.path, 0, 1, &done, &f) != STATUS_OK, "%s", f.text);
    gsl_test(numbers_shard(&w, b.path, 1, 2, &done, &f) != STATUS_OK, "%s", f.text);
    numbers_are_whole(&w, folder, 2, "a part in two folders");
    gsl_test(batch_store_read(&w.w, folder, 2, NULL, NULL, &s, &f) != STATUS_OK, "%s", f.text);
    gsl_test_int(s.twice, done.mine, "batches that are there twice");
    batch_store_free(&s);
    folder_remove(&b);
    const test_folder other = folder_make();
    const char *const unlike[] = {a.path, other.path};
    w.n.sign = -1;
    gsl_test(numbers_shard(&w, other.path, 1, 2, &done, &f) != STATUS_OK, "%s", f.text);
    gsl_test(batch_store_read(&w.w, unlike, 2, NULL, NULL, &s, &f) != STATUS_REFUSED ||
                 strstr(f.text, a.path) == NULL || strstr(f.text, other.path) == NULL,
             "two answers to one batch: both are named: %s", f.text);
    batch_store_free(&s);
    folder_remove(&a);
    folder_remove(&other);
}

static void lost(void)
{
    const test_folder of = folder_make();
    const char *const folder[] = {of.path};
    numbers_work w;
    shard_outcome done;
    fault f = {""};
    numbers_begin(&w);
    w.n.crashes = 17;
    gsl_test(numbers_shard(&w, of.path, 0, 1, &done, &f) != STATUS_OK, "%s", f.text);
    gsl_test(done.lost != 1 || done.done != NUMBERS_BATCHES - 1, "one of all: %d, %d", done.lost,
             done.done);
    w.n.crashes = -1;
    gsl_test(numbers_shard(&w, of.path, 0, 1, &done, &f) != STATUS_OK, "%s", f.text);
    gsl_test_int(done.done, 1, "what was lost");
    numbers_are_whole(&w, folder, 1, "one was lost");
    folder_remove(&of);
}

static void failures(void)
{
    const test_folder of = folder_make();
    const char *const folder[] = {of.path};
    numbers_work w;
    shard_outcome done;
    fault f = {""};
    struct rlimit kept, small;
    numbers_begin(&w);
    w.n.fails = 39;
    gsl_test(numbers_shard(&w, of.path, 0, 1, &done, &f) != STATUS_FAULT ||
                 strcmp(f.text, "batch 39 has no room") != 0,
             "its own line: %s", f.text);
    w.n.fails = -1;
    const int there = folder_entries(of.path);
    getrlimit(RLIMIT_FSIZE, &kept);
    small = kept;
    small.rlim_cur = 100; /* [bytes] */
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    gsl_test(numbers_shard(&w, of.path, 0, 1, &done, &f) != STATUS_FAULT ||
                 strstr(f.text, "cannot be written") == NULL || strchr(f.text, '\n') != NULL,
             "no room: %s", f.text);
    setrlimit(RLIMIT_FSIZE, &kept);
    gsl_test_int(folder_entries(of.path), there, "nothing half-written is left");
    gsl_test(numbers_shard(&w, of.path, 0, 1, &done, &f) != STATUS_OK, "%s", f.text);
    gsl_test_int(done.before, there, "what was there is not done again");
    numbers_are_whole(&w, folder, 1, "after a full disk");
    folder_remove(&of);
}

static void killed(void)
{
    const test_folder of = folder_make();
    const char *const folder[] = {of.path};
    numbers_work w;
    shard_outcome done;
    fault f = {""};
    uint64_t seed = 20;
    numbers_begin(&w);
    w.n.wait = 1000;
    for (int i = 0; i < 20; i++) {
        const pid_t child = fork();
        if (child == 0) {
            setpgid(0, 0);
            numbers_shard(&w, of.path, 0, 1, &done, &f);
            _exit(0);
        }
        setpgid(child, child);
        usleep((useconds_t)random_below(&seed, 4000));
        kill(i % 2 == 0 ? -child : child,
             SIGKILL); /* even: the whole process group; odd: only the first process */
        waitpid(child, NULL, 0);
    }
    gsl_test(numbers_shard(&w, of.path, 0, 1, &done, &f) != STATUS_OK, "%s", f.text);
    gsl_test_int(done.before + done.done, NUMBERS_BATCHES, "the rest is done now");
    numbers_are_whole(&w, folder, 1, "killed twenty times");
    folder_remove(&of);
}

static void interrupted(void)
{
    const test_folder of = folder_make();
    int ends[2];
    numbers_work w;
    shard_outcome done;
    fault f = {""};
    numbers_begin(&w);
    w.n.wait = 2000;
    gsl_test(pipe(ends) != 0 || write(ends[1], "x", 1) != 1, "a pipe that can be read");
    const shard_request request = {.count = 1, .into = of.path, .jobs = 2, .stop = ends[0]};
    gsl_test(shard_run(&w.w, &request, &done, &f) != STATUS_OK, "%s", f.text);
    gsl_test(!done.interrupted || done.done == NUMBERS_BATCHES, "it ends: %d done", done.done);
    close(ends[0]);
    close(ends[1]);
    folder_remove(&of);
}

static void parsed(void)
{
    static const char *const bad[] = {"",    "1",     "1/",   "/2",   "0/2",  "3/2",
                                      "1/0", "1/2/3", " 1/2", "-1/2", "1/2 ", "1/100000000000"};
    int index, count;
    fault f;
    gsl_test(shard_parse("2/4", &index, &count, &f) != STATUS_OK || index != 1 || count != 4,
             "the second of four");
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        gsl_test(shard_parse(bad[i], &index, &count, &f) != STATUS_REFUSED ||
                     strstr(f.text, "K/N") == NULL,
                 "'%s' is no shard", bad[i]);
}

int main(void)
{
    parsed();
    one_folder();
    two_folders();
    lost();
    failures();
    killed();
    interrupted();
    return gsl_test_summary();
}
