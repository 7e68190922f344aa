#include "harness/study/progress.h"

#include <stddef.h>
#include <sys/ioctl.h>

enum { COLUMNS = 79, LINE = 400 };
/* [s] between two lines, and before any time left is told */
static const double interval = 0.2, first_word = 1;
static const double least_share = 0.01; /* that a guess may rest on */

progress progress_begin(FILE *to, const char *things, int count, double now)
{
    return (progress){.to = to, .things = things, .count = count, .begun = now, .last = now};
}

int progress_is_due(const progress *p, double now)
{
    return p->to != NULL && now - p->last >= interval;
}

/* Columns that a line may have. */
static int columns_of(FILE *to)
{
    struct winsize size = {0};
    if (ioctl(fileno(to), TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
        return COLUMNS;
    return size.ws_col - 1;
}

/* "45 s", "3 min", "1 h 10 min". */
static void write_time(double seconds, char *text, size_t size)
{
    const int minutes = (int)(seconds / 60 + 0.5);
    if (seconds < 90)
        snprintf(text, size, "%.0f s", seconds);
    else if (minutes < 60)
        snprintf(text, size, "%d min", minutes);
    else
        snprintf(text, size, "%d h %d min", minutes / 60, minutes % 60);
}

/* The line in place of the one that stands there. */
static void write_over(progress *p, const char *line)
{
    const int most = columns_of(p->to);
    const int width = fprintf(p->to, "\r%.*s", most, line) - 1;
    for (int i = width; i < p->width; i++)
        fputc(' ', p->to);
    fputc('\r', p->to);
    fflush(p->to);
    p->width = width;
}

void progress_show(progress *p, double now, int done, double share, const char *what)
{
    char line[LINE], left[64], words[96] = "";
    const double spent = now - p->begun;
    if (p->to == NULL)
        return;
    if (share >= least_share && spent >= first_word) {
        write_time(spent * (1 - share) / share, left, sizeof left);
        snprintf(words, sizeof words, ", about %s left", left);
    }
    snprintf(line, sizeof line, "%s %d of %d, %.0f %%%s: %s", p->things, done, p->count,
             100 * share, words, what);
    write_over(p, line);
    p->last = now;
}

void progress_end(progress *p)
{
    if (p->to != NULL && p->width > 0)
        write_over(p, "");
}
