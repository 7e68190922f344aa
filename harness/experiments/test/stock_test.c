/* Folders with files that are not what they should be: each is told in one line, none is taken. */
#include "harness/experiments/test/number_work.h"

/* A folder with all batches of the work, to be spoilt. */
typedef struct filled {
    test_folder of;
    const char *folder[1];
    numbers_work w;
    char name[BATCH_NAME]; /* of batch 4 */
    folder_entry path;
} filled;

static void fill(filled *out)
{
    shard_outcome done;
    char stem[BATCH_STEM];
    fault f = {""};
    out->of = folder_make();
    out->folder[0] = out->of.path;
    numbers_begin(&out->w);
    gsl_test(numbers_shard(&out->w, out->of.path, 0, 1, &done, &f) != STATUS_OK, "%s", f.text);
    batch_stem(&out->w.w, stem);
    batch_name(stem, 3, out->name);
    out->path = folder_path(&out->of, out->name);
}

/* What is taken of it, and what is said. */
static status take(filled *of, stock *s, char said[400], fault *f)
{
    memset(said, 0, 400);
    FILE *tell = fmemopen(said, 399, "w");
    const status outcome = stock_take(&of->w.w, of->folder, 1, NULL, tell, s, f);
    fclose(tell);
    return outcome;
}

static long size_of(const char *path)
{
    struct stat there;
    return stat(path, &there) == 0 ? (long)there.st_size : -1;
}

/* It counts as missing, is named once, and is done again. */
static void is_done_again(filled *of, const char *what)
{
    stock s;
    shard_outcome done;
    char said[400], text[200];
    fault f = {""};
    gsl_test(take(of, &s, said, &f) != STATUS_OK, "%s: %s", what, f.text);
    gsl_test(s.damaged != 1 || strstr(said, of->name) == NULL ||
                 strchr(said, '\n') != said + strlen(said) - 1,
             "%s: %s", what, said);
    stock_missing(&s, &of->w.w, text, sizeof text);
    gsl_test(strcmp(text, "1 of 40 batches is missing: 4") != 0, "%s: %s", what, text);
    stock_free(&s);
    gsl_test(numbers_shard(&of->w, of->of.path, 0, 1, &done, &f) != STATUS_OK, "%s", f.text);
    gsl_test_int(done.done, 1, "%s: it alone is done again", what);
    numbers_are_whole(&of->w, of->folder, 1, what);
}

static void change_byte(const char *path, long at)
{
    FILE *file = fopen(path, "r+b");
    fseek(file, at, SEEK_SET);
    const int old = fgetc(file);
    fseek(file, at, SEEK_SET);
    fputc(old ^ 4, file);
    fclose(file);
}

static void damaged(void)
{
    filled of;
    fill(&of);
    const long size = size_of(of.path.text);
    gsl_test(truncate(of.path.text, size / 2) != 0, "cut in two");
    is_done_again(&of, "cut short");
    gsl_test(truncate(of.path.text, 0) != 0, "emptied");
    is_done_again(&of, "empty");
    change_byte(of.path.text, 20);
    is_done_again(&of, "altered in its line");
    change_byte(of.path.text, size - 45);
    is_done_again(&of, "altered in its bytes");
    folder_remove(&of.of);
}

/* Refused in a merge and as a place to go on; the line has these words. */
static void is_refused(filled *of, const char *words)
{
    stock s;
    shard_outcome done;
    fault f = {""};
    gsl_test(stock_take(&of->w.w, of->folder, 1, NULL, NULL, &s, &f) != STATUS_REFUSED ||
                 strstr(f.text, words) == NULL || strchr(f.text, '\n') != NULL ||
                 strstr(f.text, of->of.path) == NULL,
             "refused for '%s': %s", words, f.text);
    stock_free(&s);
    gsl_test(numbers_shard(&of->w, of->of.path, 0, 1, &done, &f) != STATUS_REFUSED,
             "nothing is added to it: %s", f.text);
}

static void foreign(void)
{
    filled of;
    fill(&of);
    const shard_work right = of.w.w;
    of.w.w.build = "build 2";
    is_refused(&of, "another build (build 1; this is build 2)");
    of.w.w = right;
    of.w.w.request = "some";
    is_refused(&of, "another request (numbers all)");
    of.w.w = right;
    of.w.w.plan = "0123";
    is_refused(&of, "other truths, scenes or formulations");
    of.w.w = right;
    of.w.w.batches = NUMBERS_BATCHES - 1;
    is_refused(&of, "take it away");
    of.w.w = right;
    fault f;
    const folder_entry text = folder_path(&of.of, "notes.batch");
    gsl_test(folder_write_text(text.text, "no batch\n", &f) != STATUS_OK, "%s", f.text);
    is_refused(&of, "no batch of this program");
    unlink(text.text);
    char stem[BATCH_STEM], name[BATCH_NAME];
    batch_stem(&of.w.w, stem);
    batch_name(stem, 4, name);
    const folder_entry other = folder_path(&of.of, name);
    gsl_test(rename(of.path.text, other.text) != 0, "in the place of another");
    is_refused(&of, "is batch 4 of 40, not what it is called");
    folder_remove(&of.of);
}

/* What the killed left, and what is none of ours. */
static void others(void)
{
    filled of;
    char part[BATCH_NAME + 40];
    shard_outcome done;
    fault f = {""};
    fill(&of);
    snprintf(part, sizeof part, "%s.part-0123456789abcdef", of.name);
    const folder_entry left = folder_path(&of.of, part), log = folder_path(&of.of, "slurm-1.out");
    gsl_test(rename(of.path.text, left.text) != 0, "as it was before it was done");
    gsl_test(folder_write_text(log.text, "some words\n", &f) != STATUS_OK, "%s", f.text);
    gsl_test(numbers_shard(&of.w, of.of.path, 0, 1, &done, &f) != STATUS_OK, "%s", f.text);
    gsl_test_int(done.done, 1, "it is done again");
    gsl_test_int(folder_entries(of.of.path), NUMBERS_BATCHES + 1, "what the killed left is gone");
    numbers_are_whole(&of.w, of.folder, 1, "files of others are left alone");
    gsl_test(!folder_holds(log.text, "some words\n"), "as they were");
    folder_remove(&of.of);
}

static void nowhere(void)
{
    numbers_work w;
    const test_folder of = folder_make();
    const folder_entry none = folder_path(&of, "none"), deep = folder_path(&of, "none/deep");
    const char *const folder[] = {none.text};
    shard_outcome done;
    batch_label label;
    stock s;
    fault f = {""};
    numbers_begin(&w);
    gsl_test(stock_take(&w.w, folder, 1, NULL, NULL, &s, &f) != STATUS_FAULT ||
                 strstr(f.text, none.text) == NULL,
             "no folder: %s", f.text);
    stock_free(&s);
    gsl_test(stock_first(of.path, &label, &f) != STATUS_REFUSED ||
                 strstr(f.text, "--shard K/N --into") == NULL,
             "an empty folder: %s", f.text);
    gsl_test(numbers_shard(&w, deep.text, 0, 1, &done, &f) != STATUS_FAULT ||
                 strstr(f.text, "cannot be made") == NULL,
             "no folder around it: %s", f.text);
    folder_remove(&of);
}

/* A batch of another processor, and one of another BLAS: machines are told, hosts alone are not. */
static void machines(void)
{
    filled of;
    stock s;
    char said[1200];
    fault f = {""};
    static const char *const other_processor[] = {"another processor", NULL, NULL},
                             *const blas[] = {NULL, "another BLAS", NULL};
    for (int i = 0; i < 3; i++) {
        batch_label label;
        FILE *from;
        long end;
        fill(&of);
        gsl_test(batch_open(of.path.text, &label, &from, &end, &f) != STATUS_OK, "%s", f.text);
        char bytes[400];
        const size_t size = fread(bytes, 1, (size_t)(end - ftell(from)), from);
        fclose(from);
        snprintf(label.node.host, sizeof label.node.host, "elsewhere");
        if (other_processor[i] != NULL)
            snprintf(label.node.processor, sizeof label.node.processor, "%s", other_processor[i]);
        if (blas[i] != NULL)
            snprintf(label.node.blas, sizeof label.node.blas, "%s", blas[i]);
        gsl_test(batch_write(of.of.path, &label, bytes, size, &f) != STATUS_OK, "%s", f.text);
        batch_label_free(&label);
        memset(said, 0, sizeof said);
        FILE *tell = fmemopen(said, sizeof said - 1, "w");
        gsl_test(stock_take(&of.w.w, of.folder, 1, NULL, NULL, &s, &f) != STATUS_OK, "%s", f.text);
        stock_tell_kinds(&s, tell);
        fclose(tell);
        gsl_test_int(s.kinds, i < 2 ? 2 : 1, "kinds of machines");
        gsl_test(i < 2 && (strstr(said, "the last digits may differ") == NULL ||
                           strstr(said, "1 on elsewhere") == NULL ||
                           strstr(said, i == 0 ? other_processor[0] : blas[1]) == NULL),
                 "what differs is told: %s", said);
        gsl_test(i == 2 && said[0] != '\0', "another host of the same kind is not told: %s", said);
        stock_free(&s);
        numbers_are_whole(&of.w, of.folder, 1, "its answers are taken");
        folder_remove(&of.of);
    }
}

int main(void)
{
    machines();
    damaged();
    foreign();
    others();
    nowhere();
    return gsl_test_summary();
}
