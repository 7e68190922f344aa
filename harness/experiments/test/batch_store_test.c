/* Folders with invalid files. */
#include <gsl/gsl_test.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/experiments/experiments_impl.h"
#include "harness/experiments/test/number_work.h"
#include "harness/records/records.h"

typedef struct filled {
    test_folder of;
    const char *folder[1];
    numbers_work w;
    char name[BATCH_NAME];
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

static status take(filled *of, batch_store *s, char printed[400], fault *f)
{
    memset(printed, 0, 400);
    FILE *messages = fmemopen(printed, 399, "w");
    const status outcome = batch_store_read(&of->w.w, of->folder, 1, NULL, messages, s, f);
    fclose(messages);
    return outcome;
}

static long size_of(const char *path)
{
    struct stat there;
    return stat(path, &there) == 0 ? (long)there.st_size : -1;
}

static void is_done_again(filled *of, const char *what)
{
    batch_store s;
    shard_outcome done;
    char printed[400], text[200];
    fault f = {""};
    gsl_test(take(of, &s, printed, &f) != STATUS_OK, "%s: %s", what, f.text);
    gsl_test(s.damaged != 1 || strstr(printed, of->name) == NULL ||
                 strchr(printed, '\n') != printed + strlen(printed) - 1,
             "%s: %s", what, printed);
    batch_store_missing(&s, &of->w.w, text, sizeof text);
    gsl_test(strcmp(text, "1 of 40 batches is missing: 4") != 0, "%s: %s", what, text);
    batch_store_free(&s);
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

static void is_refused(filled *of, const char *words)
{
    batch_store s;
    shard_outcome done;
    fault f = {""};
    gsl_test(batch_store_read(&of->w.w, of->folder, 1, NULL, NULL, &s, &f) != STATUS_REFUSED ||
                 strstr(f.text, words) == NULL || strchr(f.text, '\n') != NULL ||
                 strstr(f.text, of->of.path) == NULL,
             "refused for '%s': %s", words, f.text);
    batch_store_free(&s);
    gsl_test(numbers_shard(&of->w, of->of.path, 0, 1, &done, &f) != STATUS_REFUSED,
             "nothing is added to it: %s", f.text);
}

static void foreign(void)
{
    filled of;
    fill(&of);
    const shard_work right = of.w.w;
    of.w.w.build = "build 2";
    is_refused(&of, "another build of beamwork (build 1; this build is build 2)");
    of.w.w = right;
    of.w.w.request = "some";
    is_refused(&of, "another request (numbers all)");
    of.w.w = right;
    of.w.w.plan = "0123";
    is_refused(&of, "other reference values, scene files or formulations");
    of.w.w = right;
    of.w.w.batches = NUMBERS_BATCHES - 1;
    is_refused(&of, "remove the file");
    of.w.w = right;
    fault f;
    const folder_entry text = folder_path(&of.of, "notes.batch");
    gsl_test(folder_write_text(text.text, "no batch\n", &f) != STATUS_OK, "%s", f.text);
    is_refused(&of, "not a batch of this program");
    unlink(text.text);
    char stem[BATCH_STEM], name[BATCH_NAME];
    batch_stem(&of.w.w, stem);
    batch_name(stem, 4, name);
    const folder_entry other = folder_path(&of.of, name);
    gsl_test(rename(of.path.text, other.text) != 0, "in the place of another");
    is_refused(&of, "contains batch 4 of 40, which does not match the name");
    folder_remove(&of.of);
}

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
    batch_store s;
    fault f = {""};
    numbers_begin(&w);
    gsl_test(batch_store_read(&w.w, folder, 1, NULL, NULL, &s, &f) != STATUS_FAULT ||
                 strstr(f.text, none.text) == NULL,
             "no folder: %s", f.text);
    batch_store_free(&s);
    gsl_test(batch_store_first(of.path, &label, &f) != STATUS_REFUSED ||
                 strstr(f.text, "that was written with --into") == NULL,
             "an empty folder: %s", f.text);
    gsl_test(numbers_shard(&w, deep.text, 0, 1, &done, &f) != STATUS_FAULT ||
                 strstr(f.text, "cannot be created") == NULL,
             "no folder around it: %s", f.text);
    folder_remove(&of);
}

static void machines(void)
{
    filled of;
    batch_store s;
    char printed[1200];
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
        memset(printed, 0, sizeof printed);
        FILE *messages = fmemopen(printed, sizeof printed - 1, "w");
        gsl_test(batch_store_read(&of.w.w, of.folder, 1, NULL, NULL, &s, &f) != STATUS_OK, "%s",
                 f.text);
        batch_store_print_kinds(&s, messages);
        fclose(messages);
        gsl_test_int(s.kinds, i < 2 ? 2 : 1, "kinds of machines");
        gsl_test(i < 2 && (strstr(printed, "the last digits may differ") == NULL ||
                           strstr(printed, "1 on elsewhere") == NULL ||
                           strstr(printed, i == 0 ? other_processor[0] : blas[1]) == NULL),
                 "what differs is told: %s", printed);
        gsl_test(i == 2 && printed[0] != '\0', "another host of the same kind is not told: %s",
                 printed);
        batch_store_free(&s);
        numbers_are_whole(&of.w, of.folder, 1, "its answers are taken");
        folder_remove(&of.of);
    }
}

static void batch_store_tests(void)
{
    machines();
    damaged();
    foreign();
    others();
    nowhere();
}

static void known_digests(void)
{
    static const struct {
        const char *text;
        int times;
        const char *right;
    } known[] = {
        {"", 1, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
        {"abc", 1, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
        {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 1,
         "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
        {"aaaaaaaaaa", 100000, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        char text[DIGEST_TEXT];
        digest d = digest_begin();
        for (int k = 0; k < known[i].times; k++)
            digest_add(&d, known[i].text, strlen(known[i].text));
        digest_text(&d, text);
        gsl_test(strcmp(text, known[i].right) != 0, "digest %zu: %s", i, text);
    }
}

static void same_numbers(void)
{
    char plus[DIGEST_TEXT], minus[DIGEST_TEXT], other[DIGEST_TEXT];
    digest a = digest_begin(), b = digest_begin(), c = digest_begin();
    digest_add_number(&a, 0.0);
    digest_add_number(&b, -0.0);
    digest_add_number(&c, 5e-324);
    digest_text(&a, plus);
    digest_text(&b, minus);
    digest_text(&c, other);
    gsl_test(strcmp(plus, minus) != 0, "-0 is 0");
    gsl_test(strcmp(plus, other) == 0, "the least number is not 0");
    a = b = digest_begin();
    digest_add_text(&a, "ab");
    digest_add_text(&a, "c");
    digest_add_text(&b, "a");
    digest_add_text(&b, "bc");
    digest_text(&a, plus);
    digest_text(&b, minus);
    gsl_test(strcmp(plus, minus) == 0, "texts keep their ends");
}

static void cut(void)
{
    static const double cost[] = {0.2, 0.2, 0.2, 3, 0.1, 0.4, 0.1};
    int first[8];
    gsl_test_int(batches_cut(7, cost, 0.5, first), 5, "batches");
    static const int right[] = {0, 2, 3, 4, 6, 7};
    gsl_test(memcmp(first, right, sizeof right) != 0, "cut where the next would be too much");
    gsl_test_int(batches_cut(0, cost, 0.5, first), 0, "of nothing no batch");
}

static void assigned(void)
{
    enum { BATCHES = 500, SHARDS = 7 };
    double cost[BATCHES], sum[SHARDS] = {0}, least = 1e300, most = 0;
    int shard[BATCHES], again[BATCHES];
    for (int i = 0; i < BATCHES; i++)
        cost[i] = 0.1 + (i * 37 % 101) * 0.01 + (i % 50 == 0) * 4;
    gsl_test(batches_assign(BATCHES, cost, SHARDS, shard) != 0 ||
                 batches_assign(BATCHES, cost, SHARDS, again) != 0,
             "dealt");
    gsl_test(memcmp(shard, again, sizeof shard) != 0, "the same again");
    for (int i = 0; i < BATCHES; i++) {
        gsl_test(shard[i] < 0 || shard[i] >= SHARDS, "batch %d has a shard", i);
        sum[shard[i]] += cost[i];
    }
    for (int k = 0; k < SHARDS; k++) {
        least = sum[k] < least ? sum[k] : least;
        most = sum[k] > most ? sum[k] : most;
    }
    gsl_test(most > 1.01 * least, "shards end together: %g to %g", least, most);
}

static void assigned_by_the_rule(void)
{
    enum { BATCHES = 300, MOST = 40 };
    double cost[BATCHES];
    int shard[BATCHES], order[BATCHES];
    for (int i = 0; i < BATCHES; i++)
        cost[i] = 1 + i * 7 % 4;
    batches_order(BATCHES, cost, order);
    for (int shards = 1; shards <= MOST; shards++) {
        double sum[MOST] = {0};
        int wrong = batches_assign(BATCHES, cost, shards, shard) != 0;
        for (int i = 0; i < BATCHES; i++) {
            int to = 0;
            for (int k = 1; k < shards; k++)
                to = sum[k] < sum[to] ? k : to;
            wrong += shard[order[i]] != to;
            sum[to] += cost[order[i]];
        }
        gsl_test_int(wrong, 0, "%d shards", shards);
    }
}

static void assignment_tests(void)
{
    assigned_by_the_rule();
    known_digests();
    same_numbers();
    cut();
    assigned();
}

static void list_is(const char *text, double ratio, int count, const double right[])
{
    integrators_list out;
    fault f = {""};
    gsl_test(integrators_list_read("step", text, ratio, &out, &f) != STATUS_OK, "%s is read: %s",
             text, f.text);
    gsl_test_int(out.count, count, "%s: values", text);
    for (int i = 0; i < count && i < out.count; i++)
        gsl_test_rel(out.value[i], right[i], 4e-16, "%s: value %d", text, i);
}

static void list_is_refused(const char *text)
{
    integrators_list out;
    fault f = {""};
    gsl_test(integrators_list_read("step", text, 2, &out, &f) != STATUS_REFUSED, "%s is refused",
             text);
    gsl_test(strstr(f.text, "--step") == NULL || strstr(f.text, text) == NULL,
             "%s: culprit and option are named: %s", text, f.text);
}

static void lists(void)
{
    list_is("0.1", 2, 1, (double[]){0.1});
    list_is("0.1,0.03", 2, 2, (double[]){0.1, 0.03});
    list_is("0.1..0.025", 2, 3, (double[]){0.1, 0.05, 0.025});
    list_is("8..1", 2, 4, (double[]){8, 4, 2, 1});
    list_is("1e-4..1e-8", 100, 3, (double[]){1e-4, 1e-6, 1e-8});
    const char *const wrong[] = {
        "",         "0",           "-1",      "0.1,",
        "0.1..0.2", "a",           "0.1;0.2", "0.1..",
        "1..1e-99", "0.1..0.05,1", "nan",     "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        list_is_refused(wrong[i]);
}

static void method_is(const char *text, scene_scheme scheme, double mass, double force, int order)
{
    integrators_method m;
    fault f = {""};
    gsl_test(integrators_method_read(text, (int)strlen(text), &m, &f) != STATUS_OK,
             "%s is read: %s", text, f.text);
    gsl_test(m.scheme != scheme || strcmp(m.name, text) != 0, "%s is that", text);
    gsl_test_int(m.order, order, "%s: order", text);
    gsl_test_abs(m.alpha.mass, mass, 1e-15, "%s: alpha_m", text);
    gsl_test_abs(m.alpha.force, force, 1e-15, "%s: alpha_f", text);
}

static void methods(void)
{
    method_is("alpha", SCENE_ALPHA, 0.8 / 1.9, 0.9 / 1.9, 2);
    method_is("alpha:rho=0.5", SCENE_ALPHA, 0, 1 / 3.0, 2);
    method_is("hht", SCENE_ALPHA, 0, 0.05, 2);
    method_is("hht:alpha=0.3", SCENE_ALPHA, 0, 0.3, 2);
    method_is("trapezoidal", SCENE_ALPHA, 0, 0, 2);
    method_is("conserving", SCENE_CONSERVING, 0, 0, 2);
    method_is("radau", SCENE_RADAU, 0, 0, 5);
    method_is("explicit", SCENE_EXPLICIT, 0, 0, 8);
    const char *const wrong[] = {"",        "alph",        "alphas",         "alpha:rho=1.5",
                                 "alpha:r", "hht:alpha=1", "radau:rho=0.5",  "trapezoidal:rho=1",
                                 "Alpha",   "alpha:rho=",  "alpha:rho=0.5x", "hht:rho=0.5"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        integrators_method m;
        fault f = {""};
        gsl_test(integrators_method_read(wrong[i], (int)strlen(wrong[i]), &m, &f) != STATUS_REFUSED,
                 "'%s' is refused", wrong[i]);
        gsl_test(strstr(f.text, wrong[i]) == NULL, "'%s' is named", wrong[i]);
    }
}

static void method_lists(void)
{
    integrators_method list[INTEGRATORS_LIST_MOST];
    int count = 0;
    fault f = {""};
    gsl_test(integrators_method_read_list(integrators_method_all, INTEGRATORS_LIST_MOST, list,
                                          &count, &f) != STATUS_OK,
             "all: %s", f.text);
    gsl_test_int(count, 6, "all");
    count = 0;
    gsl_test(integrators_method_read_list("radau,alpha,radau", INTEGRATORS_LIST_MOST, list, &count,
                                          &f) != STATUS_REFUSED,
             "given twice");
    count = 0;
    gsl_test(integrators_method_read_list("radau,alpha", 1, list, &count, &f) != STATUS_REFUSED,
             "too many");
}

static void words_tests(void)
{
    lists();
    methods();
    method_lists();
}

int main(void)
{
    batch_store_tests();
    assignment_tests();
    words_tests();
    return gsl_test_summary();
}
