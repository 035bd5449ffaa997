/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "base/language.h"
#include "plot_parts.h"

/* The words beside the profile. */

#define SIDE_LEAST 24 /* columns that make a paragraph worth while */

struct notes {
    struct ceduo_canvas *canvas;
    const struct ceduo_picture *picture;
    int left, width, row, end;
};

__attribute__((format(printf, 3, 4))) static void note(struct notes *n, enum ceduo_role role, const char *format, ...)
{
    struct text line = {0};
    va_list args;
    bool room = n->row < n->end;
    va_start(args, format);
    ceduo_text_vformat(&line, format, args);
    va_end(args);
    ceduo_plot_put_fitting(n->canvas, n->left, n->row, room ? n->width : 0, role, 1, &line);
    n->row += room;
}

/* Under a heading, set in by a blank. */
#define NOTE_IN(n, ...)                                                                                                        \
    do {                                                                                                                       \
        LOCAL_TEXT(in);                                                                                                        \
        ceduo_text_format(&in, __VA_ARGS__);                                                                                   \
        note(n, CEDUO_ROLE_TEXT, " %s", in.bytes);                                                                             \
    } while (0)

static void note_scale(struct notes *n, double factor)
{
    if (factor == 1)
        note(n, CEDUO_ROLE_DIM, _("true to scale"));
    else
        note(n, CEDUO_ROLE_WARN, factor > 1 ? _("heights drawn %g times") : _("heights drawn at %g %%"),
             factor > 1 ? factor : 100 * factor);
}

static void note_ways(struct notes *n)
{
    const struct ceduo_picture *p = n->picture;
    const struct ceduo_run_snapshot *s = ceduo_plot_sight(p);
    const struct ceduo_option *option = ceduo_plot_option(p);
    bool wooded = ceduo_plot_wooded(p) && option && ceduo_plot_has_stems(option);
    if (!s)
        note(n, CEDUO_ROLE_DIM, _("ways not computed yet"));
    if (s && s->trajectories_count > 0) {
        note(n, CEDUO_ROLE_CLOUD, wooded ? _("%zu ways of %llu through") : _("%zu ways of %llu"), s->trajectories_count,
             (unsigned long long)s->flown.rocks);
        note(n, CEDUO_ROLE_CLOUD, wooded ? " %s" : "%s",
             !wooded        ? _("without forest")
             : option->name ? option->name
                            : _("the forest"));
    }
    if (p->stems_count > 0)
        note(n, CEDUO_ROLE_STEM, _("stems this rock came to"));
}

static void note_belt(struct notes *n, const struct ceduo_belt *belt)
{
    LOCAL_TEXT(name);
    ceduo_plot_belt_name(&name, belt);
    if (n->row + 3 < n->end)
        n->row++;
    note(n, CEDUO_ROLE_BELT, "%s", ceduo_text_string(&name));
    note(n, CEDUO_ROLE_TEXT, " %s\xe2\x80\x93%s m", SHORTEST(belt->from_given), SHORTEST(belt->to_given));
    double count = ceduo_stand_shoots(&belt->stand) + ceduo_stand_trees(&belt->stand);
    if (!(count > 0)) {
        note(n, CEDUO_ROLE_TEXT, " %s", _("no stems"));
        return;
    }
    NOTE_IN(n, _("%.*f stems/ha"), count < 10 ? 1 : 0, count);
    NOTE_IN(n, _("up to %g m high"), ceduo_plot_tallest(&belt->stand));
}

static void note_control(struct notes *n, size_t c)
{
    const struct ceduo_arrivals *a = ceduo_plot_arrivals(n->picture, c);
    const struct ceduo_arrivals *bare = ceduo_plot_bare_arrivals(n->picture, c);
    const struct ceduo_control *control = &n->picture->scene->controls[c];
    if (!a || !bare || n->row + 2 >= n->end)
        return;
    n->row++;
    if (ceduo_plot_wooded(n->picture)) {
        note(n, CEDUO_ROLE_CONTROL, _("At %s m, wood (bare)"), SHORTEST(control->x_given));
        NOTE_IN(n, _("%.0f (%.0f) of 1000"), a->reach_probability * 1000, bare->reach_probability * 1000);
        if (!isnan(a->exceed_probability))
            NOTE_IN(n, "%.0f (%.0f) > %g kJ", a->exceed_probability * 1000, bare->exceed_probability * 1000,
                    control->accepted * J_TO_KJ);
        return;
    }
    note(n, CEDUO_ROLE_CONTROL, _("At %s m without forest"), SHORTEST(control->x_given));
    NOTE_IN(n, _("%.0f of 1000 arrive"), a->reach_probability * 1000);
    if (!isnan(a->exceed_probability))
        NOTE_IN(n, _("%.0f with > %g kJ"), a->exceed_probability * 1000, control->accepted * J_TO_KJ);
}

/* The factor alone, at the right of the top row. */
static void put_factor(struct ceduo_canvas *canvas, const struct ceduo_area *area, double factor)
{
    bool words = area->width >= 30;
    struct text text = {0};
    if (factor == 1)
        return;
    if (factor > 1)
        ceduo_text_then(&text, " ", words ? _("heights drawn %g times") : "\xc3\x97%g", factor);
    else
        ceduo_text_then(&text, " ", words ? _("heights drawn at %g %%") : "%g %%", 100 * factor);
    ceduo_plot_put_right(canvas, area->left + area->width - 1, area->top, area->width / 2, CEDUO_ROLE_WARN, &text);
}

bool ceduo_plot_profile_notes(struct ceduo_canvas *canvas, const struct ceduo_area *area, const struct ceduo_picture *picture,
                              const struct ceduo_frame *frame, double factor)
{
    int end = area->left + area->width, left = frame->left + frame->width + 2;
    if (end - left < SIDE_LEAST) {
        put_factor(canvas, area, factor);
        return false;
    }
    struct notes n = {canvas, picture, left, end - left, area->top + 2, frame->top + frame->height};
    const struct ceduo_option *option = ceduo_plot_option(picture);
    note_scale(&n, factor);
    note_ways(&n);
    for (size_t c = 0; c < picture->scene->controls_count; c++)
        note_control(&n, c);
    for (size_t i = 0; option && i < option->belts_count; i++)
        note_belt(&n, &option->belts[i]);
    return true;
}
