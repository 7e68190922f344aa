/* Threads that share a loop: every index once, whatever their number; thousands of rounds; threads
 * that sleep are woken. */
#include <gsl/gsl_test.h>
#include <string.h>
#include <time.h>

#include "harness/numerics/numerics.h"

enum { TEST_TEAM_MOST = 1000 };

static void add_one(void *context, int first, int end)
{
    int *visits = context;
    for (int i = first; i < end; i++)
        visits[i]++;
}

static void every_index_once(int threads)
{
    static const int counts[] = {0, 1, 2, 3, 7, 64, TEST_TEAM_MOST};
    int visits[TEST_TEAM_MOST] = {0}, expected = 0;
    thread_team *t = NULL;
    fault f = {""};
    gsl_test(team_alloc(threads, &t, &f) != STATUS_OK, "%d threads (%s)", threads, f.text);
    gsl_test((t == NULL) != (threads <= 1), "a team of one is none");
    for (int round = 0; round < 2000; round++) {
        const int count = counts[round % 7];
        memset(visits, 0, sizeof visits);
        team_run(t, count, add_one, visits);
        for (int i = 0; i < TEST_TEAM_MOST; i++)
            expected += visits[i] == (i < count);
        if (round % 500 == 0)
            nanosleep(&(struct timespec){.tv_nsec = 2000000},
                      NULL); /* long enough for the others to fall asleep */
    }
    gsl_test_int(expected, 2000 * TEST_TEAM_MOST, "%d threads: every index once in every round",
                 threads);
    team_free(t);
}

static void count_parts(void *context, int first, int end)
{
    (void)end;
    ((int *)context)[first] = 1; /* each part begins at an index of its own */
}

/* However many are asked for, there are TEAM_MOST at most; as many parts as threads. */
static void no_more_than_there_is_room_for(int threads)
{
    int begins[TEST_TEAM_MOST] = {0}, parts = 0;
    thread_team *t = NULL;
    fault f = {""};
    gsl_test(team_alloc(threads, &t, &f) != STATUS_OK, "%d threads (%s)", threads, f.text);
    team_run(t, TEST_TEAM_MOST, count_parts, begins);
    for (int i = 0; i < TEST_TEAM_MOST; i++)
        parts += begins[i];
    gsl_test_int(parts, threads < TEAM_MOST ? threads : TEAM_MOST, "%d threads: parts", threads);
    team_free(t);
}

enum { PIECES = 500 };

typedef struct relay_log {
    int held[TEAM_SLOTS], fills[PIECES], wrong, taken, last; /* last: piece that is the last one */
} relay_log;

static void write_piece(void *context, int piece, int slot)
{
    relay_log *log = context;
    log->fills[piece]++;
    log->held[slot] = 7 * piece;
}

static int read_piece(void *context, int piece, int slot)
{
    relay_log *log = context;
    log->wrong += piece != log->taken++ || log->held[slot] != 7 * piece;
    return piece != log->last;
}

/* In order, each once, and what was filled is still there; nothing behind the last that is wanted.
 */
static void relays(int threads)
{
    thread_team *t = NULL;
    fault f = {""};
    gsl_test(team_alloc(threads, &t, &f) != STATUS_OK, "%d threads (%s)", threads, f.text);
    int wrong = 0, taken = 0, expected = 0;
    for (int round = 0; round < 400; round++) {
        const int pieces = round % PIECES, last = round % 3 == 0 ? pieces / 2 : PIECES;
        relay_log log = {.last = last};
        team_relay(t, pieces, write_piece, read_piece, &log);
        taken += log.taken;
        expected += last < pieces ? last + 1 : pieces;
        wrong += log.wrong;
        for (int i = 0; i < PIECES; i++) {
            const int most = i < pieces, least = i < log.taken;
            wrong += log.fills[i] < least || log.fills[i] > most;
        }
    }
    gsl_test_int(wrong, 0, "%d threads: pieces in order, each once", threads);
    gsl_test_int(taken, expected, "%d threads: all pieces that are wanted", threads);
    team_free(t);
}

int main(void)
{
    no_more_than_there_is_room_for(5);
    no_more_than_there_is_room_for(TEAM_MOST);
    no_more_than_there_is_room_for(TEAM_MOST + 1);
    no_more_than_there_is_room_for(10 * TEAM_MOST);
    for (int threads = 1; threads <= 4; threads++)
        every_index_once(threads);
    for (int threads = 1; threads <= 4; threads++)
        relays(threads);
    thread_team *unused = NULL;
    gsl_test(team_alloc(3, &unused, NULL) != STATUS_OK, "a team that is never used");
    team_free(unused);
    team_free(NULL);
    return gsl_test_summary();
}
