# SPDX-License-Identifier: GPL-3.0-or-later
# ceduo from R: read a scene, change it, simulate it, read its figures. Build the shim once in this folder:
#
#     R CMD SHLIB ceduo_r.c -lceduo
#
# and then, in R:
#
#     source("ceduo.R")
#     scene <- ceduo_open("paper-site")
#     ceduo_set(scene, "forest[0].stand.stools.per_ha", 800)
#     ceduo_simulate(scene, rocks = 1000)
#     ceduo_get(scene, "options[0].controls[0].wooded.reach_probability")   # value, low and high end
#     ceduo_close(scene)
#
# Paths to set are listed by `ceduo --list-parameters`. Paths to get are those of the JSON of `ceduo --batch --format json`,
# or those to set. Options and controls of ceduo_samples() count from 0, as in paths; option -1 is without forest. See ceduo(3).
dyn.load(paste0("ceduo_r", .Platform$dynlib.ext))

ceduo_open <- function(path) .Call("r_open", path)
ceduo_set <- function(scene, path, value) invisible(.Call("r_set", scene, path, as.character(value)))
ceduo_simulate <- function(scene, rocks = 0, threads = 1) invisible(.Call("r_simulate", scene, rocks, threads))
ceduo_get <- function(scene, path) .Call("r_get", scene, path)
ceduo_samples <- function(scene, quantity, option = -1, control = 0) .Call("r_samples", scene, option, control, quantity)
ceduo_close <- function(scene) invisible(.Call("r_close", scene))

# Draw the share of rocks that arrive, by the number of standards, and the energies of those that arrive.
ceduo_example <- function(path = "four-systems", picture = "standards.pdf") {
  option <- "options[coppice with standards]"
  scene <- ceduo_open(path)
  standards <- seq(0, 200, 20)
  shares <- sapply(standards, function(n) {
    ceduo_set(scene, paste0(option, ".forest[0].stand.trees[0].per_ha"), n)
    ceduo_simulate(scene)
    ceduo_get(scene, paste0(option, ".controls[0].wooded.reach_probability"))
  })
  pdf(picture, width = 9, height = 4)
  par(mfrow = c(1, 2))
  matplot(standards, t(shares), type = "l", lty = c(1, 2, 2), col = 1, xlab = "standards per ha", ylab = "share that arrives")
  hist(ceduo_samples(scene, "energy_kJ", option = 2), main = "200 standards per ha", xlab = "energy, kJ", ylab = "rocks")
  dev.off()
  ceduo_close(scene)
}
