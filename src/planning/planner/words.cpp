#include "planning/planner/words.h"

#include <algorithm>
#include <array>
#include <utility>

namespace parvis::planner {
namespace {

constexpr auto french = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"Select", "Choisir"},
    {"Insert", "Insérer"},
    {"Measure", "Mesurer"},
    {"Surface", "Surface"},
    {"Plan", "Plan"},
    {"Street", "Rue"},
    {"Balcony", "Balcon"},
    {"Catalogue", "Catalogue"},
    {"Undo", "Annuler"},
    {"Redo", "Rétablir"},
    {"Save", "Enregistrer"},
    {"Delete", "Supprimer"},
    {"Design", "Projet"},
    {"Name", "Nom"},
    {"Kind", "Modèle"},
    {"Position", "Position"},
    {"Heading", "Orientation"},
    {"Width", "Largeur"},
    {"Depth", "Profondeur"},
    {"Height", "Hauteur"},
    {"Colour", "Couleur"},
    {"Material", "Matériau"},
    {"Group", "Groupe"},
    {"Locked", "Verrouillé"},
    {"mixed", "divers"},
    {"Steps", "Étapes"},
    {"search", "chercher"},
    {"all", "tout"},
    {"seats", "assises"},
    {"shade", "ombre"},
    {"green", "vert"},
    {"street", "rue"},
    {"own", "à moi"},
    {"free", "libre"},
    {"grid", "grille"},
    {"line", "ligne"},
    {"even spacing", "espacement égal"},
    {"right angle", "angle droit"},
    {"crossing", "croisement"},
    {"end", "extrémité"},
    {"Press K for the catalogue.", "K ouvre le catalogue."},
    {"Click an object to select it; drag it to move it. Shift adds to the selection.",
     "Cliquez un objet pour le choisir, tirez-le pour le déplacer. Maj ajoute à la sélection."},
    {"Click where it shall stand; drag for a row; Q and E turn it. Esc ends.",
     "Cliquez où le poser ; tirez pour une rangée ; Q et E le tournent. Échap termine."},
    {"Move the pointer and click, or type a distance and Enter. Esc takes it back.",
     "Déplacez le pointeur et cliquez, ou tapez une distance et Entrée. Échap l'annule."},
    {"Let go where it shall stand, or type a distance and Enter. Esc takes it back.",
     "Relâchez où le poser, ou tapez une distance et Entrée. Échap l'annule."},
    {"Click two points to measure from one to the other. M: an area.",
     "Cliquez deux points pour mesurer de l'un à l'autre. M : une surface."},
    {"Click the corners of the area; Enter or the first corner closes it. M: a height.",
     "Cliquez les coins ; Entrée ou le premier coin ferme la surface. M : une hauteur."},
    {"Click the foot, then the top: the height from one to the other. M: a slope.",
     "Cliquez le pied, puis le haut : la hauteur de l'un à l'autre. M : une pente."},
    {"Click two points: the slope from one to the other. M: a distance.",
     "Cliquez deux points : la pente de l'un à l'autre. M : une distance."},
    {"Let go where the end shall be. Esc takes it back.", "Relâchez où placer l'extrémité. Échap l'annule."},
    {"Measured", "Mesure"},
    {"Keep this view", "Garder cette vue"},
    {"compared in colours", "comparaison en couleurs"},
    {"drag the line between the designs", "tirez la ligne entre les projets"},
    {"side by side", "côte à côte"},
    {"Click the corners of the surface; Enter or the first corner closes it.",
     "Cliquez les coins de la surface ; Entrée ou le premier coin la ferme."},
    {"Click a window or a balcony to stand there.", "Cliquez une fenêtre ou un balcon pour s'y placer."},
    {"saved", "enregistré"},
    {"nothing selected", "rien de choisi"},
    {"objects", "objets"},
    {"Turn", "Tourner"},
    {"Duplicate", "Dupliquer"},
    {"Space evenly", "Espacer"},
    {"Align", "Aligner"},
    {"All like this", "Tous pareils"},
});

}  // namespace

Language language_of(std::string_view locale) {
  return locale.starts_with("fr") ? Language::french : Language::english;
}

std::string in_language(std::string_view english, Language language) {
  if (language == Language::english) return std::string(english);
  const auto* const found =
      std::ranges::find(french, english, &std::pair<std::string_view, std::string_view>::first);
  return std::string(found == french.end() ? english : found->second);
}

}  // namespace parvis::planner
