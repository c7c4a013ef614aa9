<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="fr" sourcelanguage="en">
<context>
    <name>Actions</name>
    <message>
        <source>&amp;New</source>
        <translation>&amp;Nouveau</translation>
    </message>
    <message>
        <source>Start an empty scene</source>
        <translation>Commencer une scène vide</translation>
    </message>
    <message>
        <source>&amp;Open...</source>
        <translation>&amp;Ouvrir...</translation>
    </message>
    <message>
        <source>Open a glTF file or an Atrium project</source>
        <translation>Ouvrir un fichier glTF ou un projet Atrium</translation>
    </message>
    <message>
        <source>&amp;Import...</source>
        <translation>&amp;Importer...</translation>
    </message>
    <message>
        <source>Add the objects of another file to this scene, in a group of their own</source>
        <translation>Ajouter à cette scène les objets d&apos;un autre fichier, dans un groupe à part</translation>
    </message>
    <message>
        <source>&amp;Save</source>
        <translation>&amp;Enregistrer</translation>
    </message>
    <message>
        <source>Save the project with its light</source>
        <translation>Enregistrer le projet avec sa lumière</translation>
    </message>
    <message>
        <source>Save &amp;As...</source>
        <translation>Enregistrer &amp;sous...</translation>
    </message>
    <message>
        <source>Save the project under another name</source>
        <translation>Enregistrer le projet sous un autre nom</translation>
    </message>
    <message>
        <source>Re&amp;vert...</source>
        <translation>Re&amp;venir à la version enregistrée...</translation>
    </message>
    <message>
        <source>Go back to the file as it was saved; what was changed since is put aside</source>
        <translation>Revenir au fichier tel qu&apos;il a été enregistré&#xa0;; ce qui a changé depuis est mis de côté</translation>
    </message>
    <message>
        <source>Recovered &amp;Work...</source>
        <translation>&amp;Travail récupéré...</translation>
    </message>
    <message>
        <source>Look at work that was not saved: kept after a crash, reverted or discarded</source>
        <translation>Voir le travail non enregistré&#xa0;: gardé après un arrêt brutal, abandonné ou rejeté</translation>
    </message>
    <message>
        <source>&amp;Find Missing Images...</source>
        <translation>&amp;Chercher les images manquantes...</translation>
    </message>
    <message>
        <source>Look for the images of materials that were not where the file says</source>
        <translation>Chercher les images des matériaux qui n&apos;étaient pas là où le fichier l&apos;indique</translation>
    </message>
    <message>
        <source>Prefere&amp;nces...</source>
        <translation>Préfére&amp;nces...</translation>
    </message>
    <message>
        <source>Language, colours, memory for light, and how often unsaved work is kept</source>
        <translation>Langue, couleurs, mémoire pour la lumière, et fréquence de sauvegarde du travail non enregistré</translation>
    </message>
    <message>
        <source>Export &amp;glTF...</source>
        <translation>Exporter en &amp;glTF...</translation>
    </message>
    <message>
        <source>Write the scene as a glTF file for other programs</source>
        <translation>Écrire la scène dans un fichier glTF pour d&apos;autres programmes</translation>
    </message>
    <message>
        <source>Export &amp;Picture...</source>
        <translation>Exporter une &amp;image...</translation>
    </message>
    <message>
        <source>Render the present view to a PNG or EXR file</source>
        <translation>Calculer la vue actuelle dans un fichier PNG ou EXR</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>&amp;Quitter</translation>
    </message>
    <message>
        <source>Close Atrium</source>
        <translation>Fermer Atrium</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Annuler</translation>
    </message>
    <message>
        <source>Take back the last change</source>
        <translation>Annuler la dernière modification</translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation>&amp;Rétablir</translation>
    </message>
    <message>
        <source>Do again what was taken back</source>
        <translation>Refaire ce qui a été annulé</translation>
    </message>
    <message>
        <source>Cu&amp;t</source>
        <translation>Cou&amp;per</translation>
    </message>
    <message>
        <source>Take the selected objects out of the scene, to be pasted elsewhere</source>
        <translation>Retirer les objets sélectionnés de la scène pour les coller ailleurs</translation>
    </message>
    <message>
        <source>&amp;Copy</source>
        <translation>&amp;Copier</translation>
    </message>
    <message>
        <source>Copy the selected objects, for this window or another one</source>
        <translation>Copier les objets sélectionnés, pour cette fenêtre ou une autre</translation>
    </message>
    <message>
        <source>&amp;Paste</source>
        <translation>C&amp;oller</translation>
    </message>
    <message>
        <source>Put the copied objects on the surface in the middle of the view</source>
        <translation>Poser les objets copiés sur la surface au milieu de la vue</translation>
    </message>
    <message>
        <source>Paste in P&amp;lace</source>
        <translation>Coller sur p&amp;lace</translation>
    </message>
    <message>
        <source>Put the copied objects where they were copied from</source>
        <translation>Poser les objets copiés là d&apos;où ils viennent</translation>
    </message>
    <message>
        <source>Copy &amp;Material</source>
        <translation>Copier le &amp;matériau</translation>
    </message>
    <message>
        <source>Copy the material of the active object</source>
        <translation>Copier le matériau de l&apos;objet actif</translation>
    </message>
    <message>
        <source>Paste M&amp;aterial</source>
        <translation>Coller le m&amp;atériau</translation>
    </message>
    <message>
        <source>Give the copied material to the selected objects</source>
        <translation>Donner le matériau copié aux objets sélectionnés</translation>
    </message>
    <message>
        <source>&amp;Duplicate</source>
        <translation>&amp;Dupliquer</translation>
    </message>
    <message>
        <source>Copy the selected objects in place</source>
        <translation>Copier sur place les objets sélectionnés</translation>
    </message>
    <message>
        <source>De&amp;lete</source>
        <translation>&amp;Supprimer</translation>
    </message>
    <message>
        <source>Remove the selected objects</source>
        <translation>Retirer les objets sélectionnés</translation>
    </message>
    <message>
        <source>Re&amp;name</source>
        <translation>Re&amp;nommer</translation>
    </message>
    <message>
        <source>Rename the active object in the scene tree</source>
        <translation>Renommer l&apos;objet actif dans l&apos;arbre de la scène</translation>
    </message>
    <message>
        <source>&amp;Hide</source>
        <translation>Mas&amp;quer</translation>
    </message>
    <message>
        <source>Hide the selected objects; hidden objects take no part in the light</source>
        <translation>Masquer les objets sélectionnés&#xa0;; un objet masqué ne compte pas dans la lumière</translation>
    </message>
    <message>
        <source>Sho&amp;w All</source>
        <translation>Tout a&amp;fficher</translation>
    </message>
    <message>
        <source>Show every hidden object</source>
        <translation>Afficher tous les objets masqués</translation>
    </message>
    <message>
        <source>&amp;Isolate</source>
        <translation>&amp;Isoler</translation>
    </message>
    <message>
        <source>Show only the selected objects, in the light of the whole scene; again to show everything</source>
        <translation>N&apos;afficher que les objets sélectionnés, dans la lumière de toute la scène&#xa0;; de nouveau pour tout afficher</translation>
    </message>
    <message>
        <source>Loc&amp;k</source>
        <translation>&amp;Verrouiller</translation>
    </message>
    <message>
        <source>Lock the selected objects in place, or unlock them</source>
        <translation>Verrouiller les objets sélectionnés à leur place, ou les déverrouiller</translation>
    </message>
    <message>
        <source>&amp;Group</source>
        <translation>&amp;Grouper</translation>
    </message>
    <message>
        <source>Put the selected objects into a new group</source>
        <translation>Mettre les objets sélectionnés dans un nouveau groupe</translation>
    </message>
    <message>
        <source>Select &amp;All</source>
        <translation>&amp;Tout sélectionner</translation>
    </message>
    <message>
        <source>Select every object that is shown and not locked</source>
        <translation>Sélectionner tous les objets affichés et non verrouillés</translation>
    </message>
    <message>
        <source>Select N&amp;one</source>
        <translation>Tout &amp;désélectionner</translation>
    </message>
    <message>
        <source>Select nothing</source>
        <translation>Ne rien sélectionner</translation>
    </message>
    <message>
        <source>&amp;Polygon</source>
        <translation>&amp;Polygone</translation>
    </message>
    <message>
        <source>Add a flat rectangle</source>
        <translation>Ajouter un rectangle plat</translation>
    </message>
    <message>
        <source>&amp;Box</source>
        <translation>&amp;Boîte</translation>
    </message>
    <message>
        <source>Add a box</source>
        <translation>Ajouter une boîte</translation>
    </message>
    <message>
        <source>&amp;Sphere</source>
        <translation>&amp;Sphère</translation>
    </message>
    <message>
        <source>Add a sphere</source>
        <translation>Ajouter une sphère</translation>
    </message>
    <message>
        <source>C&amp;ylinder</source>
        <translation>C&amp;ylindre</translation>
    </message>
    <message>
        <source>Add a cylinder</source>
        <translation>Ajouter un cylindre</translation>
    </message>
    <message>
        <source>&amp;Cone</source>
        <translation>&amp;Cône</translation>
    </message>
    <message>
        <source>Add a cone</source>
        <translation>Ajouter un cône</translation>
    </message>
    <message>
        <source>&amp;Disc</source>
        <translation>&amp;Disque</translation>
    </message>
    <message>
        <source>Add a disc</source>
        <translation>Ajouter un disque</translation>
    </message>
    <message>
        <source>P&amp;oint Light</source>
        <translation>Lumière p&amp;onctuelle</translation>
    </message>
    <message>
        <source>Add a lamp that shines in all directions</source>
        <translation>Ajouter une lampe qui éclaire dans toutes les directions</translation>
    </message>
    <message>
        <source>Spo&amp;t Light</source>
        <translation>Pro&amp;jecteur</translation>
    </message>
    <message>
        <source>Add a lamp with a cone of light</source>
        <translation>Ajouter une lampe avec un cône de lumière</translation>
    </message>
    <message>
        <source>S&amp;un</source>
        <translation>Sol&amp;eil</translation>
    </message>
    <message>
        <source>Add sunlight</source>
        <translation>Ajouter la lumière du soleil</translation>
    </message>
    <message>
        <source>Day&amp;light</source>
        <translation>Lumière du jo&amp;ur</translation>
    </message>
    <message>
        <source>Add a sun and a sky in one step</source>
        <translation>Ajouter un soleil et un ciel en une étape</translation>
    </message>
    <message>
        <source>&amp;Area Light</source>
        <translation>Lumière sur&amp;facique</translation>
    </message>
    <message>
        <source>Add a luminous disc</source>
        <translation>Ajouter un disque lumineux</translation>
    </message>
    <message>
        <source>&amp;IES Luminaire...</source>
        <translation>Luminaire &amp;IES...</translation>
    </message>
    <message>
        <source>Add a lamp that shines as a maker&apos;s photometric file (IES, EULUMDAT) says</source>
        <translation>Ajouter une lampe qui éclaire comme l&apos;indique un fichier photométrique (IES, EULUMDAT)</translation>
    </message>
    <message>
        <source>Ca&amp;mera</source>
        <translation>Ca&amp;méra</translation>
    </message>
    <message>
        <source>Add a camera that sees the present view</source>
        <translation>Ajouter une caméra qui voit la vue actuelle</translation>
    </message>
    <message>
        <source>&amp;Select</source>
        <translation>&amp;Sélectionner</translation>
    </message>
    <message>
        <source>&amp;Move</source>
        <translation>&amp;Déplacer</translation>
    </message>
    <message>
        <source>Move the selected objects</source>
        <translation>Déplacer les objets sélectionnés</translation>
    </message>
    <message>
        <source>&amp;Rotate</source>
        <translation>&amp;Tourner</translation>
    </message>
    <message>
        <source>Turn the selected objects</source>
        <translation>Tourner les objets sélectionnés</translation>
    </message>
    <message>
        <source>S&amp;cale</source>
        <translation>&amp;Redimensionner</translation>
    </message>
    <message>
        <source>Scale the selected objects</source>
        <translation>Changer la taille des objets sélectionnés</translation>
    </message>
    <message>
        <source>S&amp;nap</source>
        <translation>Ma&amp;gnétisme</translation>
    </message>
    <message>
        <source>Move, turn and scale in steps and onto faces of other objects; Ctrl turns this round while dragging</source>
        <translation>Déplacer, tourner et redimensionner par pas et contre les faces d&apos;autres objets&#xa0;; Ctrl inverse cela pendant le geste</translation>
    </message>
    <message>
        <source>Slide on S&amp;urfaces</source>
        <translation>Glisser sur les s&amp;urfaces</translation>
    </message>
    <message>
        <source>An object that is dragged goes on the floor, table or wall under the cursor</source>
        <translation>L&apos;objet déplacé se pose sur le sol, la table ou le mur sous le curseur</translation>
    </message>
    <message>
        <source>Turn &amp;with Surfaces</source>
        <translation>Tourner &amp;avec les surfaces</translation>
    </message>
    <message>
        <source>An object that slides onto another surface turns with it, as pictures and wall lights do</source>
        <translation>L&apos;objet qui glisse sur une autre surface tourne avec elle, comme un tableau ou une applique</translation>
    </message>
    <message>
        <source>Drop to Sur&amp;face</source>
        <translation>Poser sur la sur&amp;face</translation>
    </message>
    <message>
        <source>Lower the selected objects until they rest on what is below</source>
        <translation>Descendre les objets sélectionnés jusqu&apos;à ce qu&apos;ils reposent sur ce qui est dessous</translation>
    </message>
    <message>
        <source>M&amp;easure Light</source>
        <translation>M&amp;esurer la lumière</translation>
    </message>
    <message>
        <source>Read the light under the cursor; a click leaves a measuring point, a click on one removes it</source>
        <translation>Lire la lumière sous le curseur&#xa0;; un clic laisse un point de mesure, un clic sur un point l&apos;enlève</translation>
    </message>
    <message>
        <source>Cop&amp;y Measuring Points</source>
        <translation>Cop&amp;ier les points de mesure</translation>
    </message>
    <message>
        <source>Copy all measuring points with their light to the clipboard, as CSV</source>
        <translation>Copier tous les points de mesure avec leur lumière dans le presse-papiers, en CSV</translation>
    </message>
    <message>
        <source>Rem&amp;ove Measuring Points</source>
        <translation>Enle&amp;ver les points de mesure</translation>
    </message>
    <message>
        <source>Take all measuring points away</source>
        <translation>Retirer tous les points de mesure</translation>
    </message>
    <message>
        <source>&amp;Frame Selection</source>
        <translation>&amp;Cadrer la sélection</translation>
    </message>
    <message>
        <source>Bring the selected objects into view</source>
        <translation>Amener les objets sélectionnés dans la vue</translation>
    </message>
    <message>
        <source>Frame &amp;All</source>
        <translation>&amp;Tout cadrer</translation>
    </message>
    <message>
        <source>Bring the whole scene into view</source>
        <translation>Amener toute la scène dans la vue</translation>
    </message>
    <message>
        <source>&amp;Walk</source>
        <translation>&amp;Marcher</translation>
    </message>
    <message>
        <source>Walk through the room: W A S D to go, mouse to look, Esc to leave</source>
        <translation>Marcher dans la pièce&#xa0;: W A S D pour avancer, la souris pour regarder, Échap pour quitter</translation>
    </message>
    <message>
        <source>&amp;Orbit about Selection</source>
        <translation>T&amp;ourner autour de la sélection</translation>
    </message>
    <message>
        <source>Turn the view about what is selected instead of about the point under the cursor</source>
        <translation>Tourner la vue autour de la sélection plutôt que du point sous le curseur</translation>
    </message>
    <message>
        <source>&amp;Next Camera</source>
        <translation>Caméra &amp;suivante</translation>
    </message>
    <message>
        <source>Look through the next camera of the scene</source>
        <translation>Regarder par la caméra suivante de la scène</translation>
    </message>
    <message>
        <source>&amp;Previous Camera</source>
        <translation>Caméra &amp;précédente</translation>
    </message>
    <message>
        <source>Look through the camera before</source>
        <translation>Regarder par la caméra précédente</translation>
    </message>
    <message>
        <source>&amp;Brighter</source>
        <translation>&amp;Plus clair</translation>
    </message>
    <message>
        <source>Raise the exposure by a third of a stop</source>
        <translation>Augmenter l&apos;exposition d&apos;un tiers de diaphragme</translation>
    </message>
    <message>
        <source>&amp;Darker</source>
        <translation>Plus som&amp;bre</translation>
    </message>
    <message>
        <source>Lower the exposure by a third of a stop</source>
        <translation>Diminuer l&apos;exposition d&apos;un tiers de diaphragme</translation>
    </message>
    <message>
        <source>Automatic &amp;Exposure</source>
        <translation>&amp;Exposition automatique</translation>
    </message>
    <message>
        <source>Go back to automatic exposure</source>
        <translation>Revenir à l&apos;exposition automatique</translation>
    </message>
    <message>
        <source>Wire&amp;frame</source>
        <translation>&amp;Fil de fer</translation>
    </message>
    <message>
        <source>Draw the edges of the light mesh over the picture</source>
        <translation>Dessiner les arêtes du maillage de lumière par-dessus l&apos;image</translation>
    </message>
    <message>
        <source>Caustic Bo&amp;xes</source>
        <translation>Cadres des causti&amp;ques</translation>
    </message>
    <message>
        <source>Outline the textures that hold light bundled by mirrors and glass</source>
        <translation>Entourer les textures qui portent la lumière concentrée par les miroirs et le verre</translation>
    </message>
    <message>
        <source>Te&amp;xel Grid</source>
        <translation>Grille des te&amp;xels</translation>
    </message>
    <message>
        <source>Draw lines between the texels of the selected objects&apos; caustics, where these are large enough to be seen</source>
        <translation>Tracer des lignes entre les texels des caustiques des objets sélectionnés, là où ils sont assez grands pour être vus</translation>
    </message>
    <message>
        <source>&amp;Particle Landings</source>
        <translation>Impacts des parti&amp;cules</translation>
    </message>
    <message>
        <source>Draw every particle where it landed on the selected objects; takes memory while it is on</source>
        <translation>Dessiner chaque particule là où elle a touché les objets sélectionnés&#xa0;; prend de la mémoire tant que c&apos;est actif</translation>
    </message>
    <message>
        <source>&amp;Flat: One Value per Face</source>
        <translation>&amp;Aplat&#xa0;: une valeur par face</translation>
    </message>
    <message>
        <source>Show every face of the mesh in the mean of its light</source>
        <translation>Afficher chaque face du maillage à la moyenne de sa lumière</translation>
    </message>
    <message>
        <source>Caustics on the &amp;Mesh</source>
        <translation>Caustiques sur le &amp;maillage</translation>
    </message>
    <message>
        <source>Show caustics at the corners of the mesh, without textures</source>
        <translation>Afficher les caustiques aux sommets du maillage, sans textures</translation>
    </message>
    <message>
        <source>Caustics in &amp;Textures</source>
        <translation>Caustiques en &amp;textures</translation>
    </message>
    <message>
        <source>Show the light as it is computed</source>
        <translation>Afficher la lumière telle qu&apos;elle est calculée</translation>
    </message>
    <message>
        <source>Textures without &amp;Restriction</source>
        <translation>Textures sans &amp;restriction</translation>
    </message>
    <message>
        <source>Show caustics as if the same number of texels covered whole surfaces</source>
        <translation>Afficher les caustiques comme si le même nombre de texels couvrait des surfaces entières</translation>
    </message>
    <message>
        <source>Inspect Caus&amp;tics</source>
        <translation>&amp;Inspecter les caustiques</translation>
    </message>
    <message>
        <source>List every surface that caustics fall on: what was decided, why, and what can be set by hand</source>
        <translation>Lister chaque surface qui reçoit des caustiques&#xa0;: ce qui a été décidé, pourquoi, et ce qui peut être réglé à la main</translation>
    </message>
    <message>
        <source>C&amp;onvergence</source>
        <translation>Con&amp;vergence</translation>
    </message>
    <message>
        <source>Plot the estimated error against run time, with every figure of the solution</source>
        <translation>Tracer l&apos;erreur estimée en fonction du temps de calcul, avec tous les chiffres de la solution</translation>
    </message>
    <message>
        <source>&amp;Look through Near Walls</source>
        <translation>&amp;Voir à travers les murs proches</translation>
    </message>
    <message>
        <source>From outside, leave out the walls and the ceiling that hide the room</source>
        <translation>De l&apos;extérieur, omettre les murs et le plafond qui cachent la pièce</translation>
    </message>
    <message>
        <source>&amp;Picture</source>
        <translation>&amp;Image</translation>
    </message>
    <message>
        <source>Show the room as the eye sees it</source>
        <translation>Afficher la pièce comme l&apos;œil la voit</translation>
    </message>
    <message>
        <source>&amp;Illuminance</source>
        <translation>É&amp;clairement</translation>
    </message>
    <message>
        <source>Show in false colour how much light arrives on surfaces, in lux</source>
        <translation>Montrer en fausses couleurs la lumière qui arrive sur les surfaces, en lux</translation>
    </message>
    <message>
        <source>&amp;Luminance</source>
        <translation>&amp;Luminance</translation>
    </message>
    <message>
        <source>Show in false colour how bright surfaces look, in cd/m²</source>
        <translation>Montrer en fausses couleurs la luminosité apparente des surfaces, en cd/m²</translation>
    </message>
    <message>
        <source>&amp;Contour Lines</source>
        <translation>Courbes de &amp;niveau</translation>
    </message>
    <message>
        <source>Draw lines of equal light at the round values of the legend, in false colour</source>
        <translation>Tracer les lignes d&apos;égale lumière aux valeurs rondes de la légende, en fausses couleurs</translation>
    </message>
    <message>
        <source>D&amp;irect Light</source>
        <translation>Lumière &amp;directe</translation>
    </message>
    <message>
        <source>Show the light that comes straight from lamps, sun and sky</source>
        <translation>Afficher la lumière qui vient directement des lampes, du soleil et du ciel</translation>
    </message>
    <message>
        <source>Diff&amp;use Light</source>
        <translation>Lumière di&amp;ffuse</translation>
    </message>
    <message>
        <source>Show the light that other surfaces reflect</source>
        <translation>Afficher la lumière renvoyée par les autres surfaces</translation>
    </message>
    <message>
        <source>&amp;Caustics</source>
        <translation>Causti&amp;ques</translation>
    </message>
    <message>
        <source>Show the light that mirrors and glass throw onto surfaces</source>
        <translation>Afficher la lumière que les miroirs et le verre projettent sur les surfaces</translation>
    </message>
    <message>
        <source>&amp;Library</source>
        <translation>&amp;Bibliothèque</translation>
    </message>
    <message>
        <source>Shapes, materials, lamps and furniture to drag into the room</source>
        <translation>Formes, matériaux, lampes et meubles à glisser dans la pièce</translation>
    </message>
    <message>
        <source>&amp;Stop</source>
        <translation>&amp;Arrêter</translation>
    </message>
    <message>
        <source>Stop computing light; the last picture stays</source>
        <translation>Arrêter le calcul de la lumière&#xa0;; la dernière image reste</translation>
    </message>
    <message>
        <source>&amp;Resume</source>
        <translation>&amp;Reprendre</translation>
    </message>
    <message>
        <source>Compute the light of the present scene</source>
        <translation>Calculer la lumière de la scène actuelle</translation>
    </message>
    <message>
        <source>&amp;Find Command...</source>
        <translation>C&amp;hercher une commande...</translation>
    </message>
    <message>
        <source>Find a command by typing its name</source>
        <translation>Trouver une commande en tapant son nom</translation>
    </message>
    <message>
        <source>&amp;Keyboard Shortcuts</source>
        <translation>&amp;Raccourcis clavier</translation>
    </message>
    <message>
        <source>List every key and what it does</source>
        <translation>Lister toutes les touches et ce qu&apos;elles font</translation>
    </message>
    <message>
        <source>&amp;About Atrium</source>
        <translation>À &amp;propos d&apos;Atrium</translation>
    </message>
    <message>
        <source>Version and licence</source>
        <translation>Version et licence</translation>
    </message>
    <message>
        <source>&amp;Element Mesh</source>
        <translation>Maillage des &amp;éléments</translation>
    </message>
    <message>
        <source>Draw the borders of the elements that light is computed with: of the selection, or of everything where nothing is selected</source>
        <translation>Tracer les bords des éléments avec lesquels la lumière est calculée : ceux de la sélection, ou tous si rien n&apos;est sélectionné</translation>
    </message>
    <message>
        <source>&amp;Links of an Element</source>
        <translation>&amp;Liens d&apos;un élément</translation>
    </message>
    <message>
        <source>Click a surface to see which other elements light its element, and how much each of them brings</source>
        <translation>Cliquer sur une surface pour voir quels autres éléments éclairent le sien, et combien chacun apporte</translation>
    </message>
    <message>
        <source>&amp;Subdivision Level</source>
        <translation>Niveau de &amp;subdivision</translation>
    </message>
    <message>
        <source>Show in false colour how often surfaces were divided into elements</source>
        <translation>Montrer en fausses couleurs combien de fois les surfaces ont été divisées en éléments</translation>
    </message>
    <message>
        <source>Link &amp;Density</source>
        <translation>&amp;Densité des liens</translation>
    </message>
    <message>
        <source>Show in false colour how many links elements have in each square metre</source>
        <translation>Montrer en fausses couleurs combien de liens les éléments ont par mètre carré</translation>
    </message>
    <message>
        <source>&amp;Ways of Particles</source>
        <translation>&amp;Trajets des particules</translation>
    </message>
    <message>
        <source>Draw some hundred particles of the selection on their way over mirrors and glass; of everything where nothing is selected</source>
        <translation>Tracer quelques centaines de particules de la sélection sur leur trajet par les miroirs et les verres ; de toute la scène si rien n&apos;est sélectionné</translation>
    </message>
    <message>
        <source>Last &amp;Update</source>
        <translation>Dernière &amp;mise à jour</translation>
    </message>
    <message>
        <source>Mark for some seconds the texels, vertices and caustic textures that the last update of the light changed</source>
        <translation>Marquer quelques secondes les texels, sommets et textures de caustiques changés par la dernière mise à jour de la lumière</translation>
    </message>
    <message>
        <source>E&amp;rror Estimate</source>
        <translation>Estimation de l&apos;e&amp;rreur</translation>
    </message>
    <message>
        <source>Measure how far off the light is at some hundred places, and show in false colour what follows for all others</source>
        <translation>Mesurer l&apos;écart de la lumière en quelques centaines de points, et montrer en fausses couleurs ce qui en découle partout ailleurs</translation>
    </message>
    <message>
        <source>&amp;Histogram</source>
        <translation>&amp;Histogramme</translation>
    </message>
    <message>
        <source>Show beside the legend in false colour how often amounts occur: on the selection, or on everything where nothing is selected</source>
        <translation>Montrer à côté de la légende des fausses couleurs la fréquence des valeurs : sur la sélection, ou partout si rien n&apos;est sélectionné</translation>
    </message>
    <message>
        <source>Select objects by clicking or with a box; drag what is selected to move it</source>
        <translation>Sélectionner des objets d&apos;un clic ou avec un cadre ; faire glisser la sélection la déplace</translation>
    </message>
    <message>
        <source>&amp;Own Axes</source>
        <translation>Axes pr&amp;opres</translation>
    </message>
    <message>
        <source>Move and turn along the axes of the object instead of those of the world</source>
        <translation>Déplacer et tourner selon les axes de l&apos;objet au lieu de ceux du monde</translation>
    </message>
    <message>
        <source>&amp;Octree of Particles</source>
        <translation>&amp;Octree des particules</translation>
    </message>
    <message>
        <source>Draw the cells of the octree that finds the particles near the selected object when it moves</source>
        <translation>Dessiner les cellules de l&apos;octree qui trouve les particules proches de l&apos;objet sélectionné quand il se déplace</translation>
    </message>
</context>
<context>
    <name>Caustics</name>
    <message>
        <source>(deleted)</source>
        <translation>(supprimé)</translation>
    </message>
    <message>
        <source>(unnamed)</source>
        <translation>(sans nom)</translation>
    </message>
    <message>
        <source>contrast %1, %2 needed</source>
        <translation>contraste %1, il faut %2</translation>
    </message>
    <message>
        <source>%1 deviations beyond chance, %2 needed</source>
        <translation>%1 écarts au-delà du hasard, il en faut %2</translation>
    </message>
    <message>
        <source> (set by hand)</source>
        <translation> (réglé à la main)</translation>
    </message>
    <message>
        <source>finer detail than the mesh has (%1)</source>
        <translation>détail plus fin que le maillage (%1)</translation>
    </message>
    <message>
        <source>as even as chance allows (%1)</source>
        <translation>aussi uniforme que le hasard le permet (%1)</translation>
    </message>
    <message>
        <source>no finer detail than the mesh has (%1)</source>
        <translation>pas de détail plus fin que le maillage (%1)</translation>
    </message>
    <message>
        <source>too few particles to say</source>
        <translation>trop peu de particules pour conclure</translation>
    </message>
    <message>
        <source>pieces too small for a texture</source>
        <translation>morceaux trop petits pour une texture</translation>
    </message>
    <message>
        <source>, part %1</source>
        <translation>, partie %1</translation>
    </message>
    <message>
        <source>, piece %1</source>
        <translation>, morceau %1</translation>
    </message>
    <message>
        <source>, small pieces</source>
        <translation>, petits morceaux</translation>
    </message>
    <message>
        <source>, back</source>
        <translation>, dos</translation>
    </message>
    <message>
        <source>Texture</source>
        <translation>Texture</translation>
    </message>
    <message>
        <source>Mesh</source>
        <translation>Maillage</translation>
    </message>
    <message>
        <source> (by hand)</source>
        <translation> (à la main)</translation>
    </message>
    <message>
        <source>set by hand to the mesh; found: %1</source>
        <translation>réglé à la main sur le maillage&#xa0;; trouvé&#xa0;: %1</translation>
    </message>
    <message>
        <source>set by hand to a texture; found: %1</source>
        <translation>réglé à la main sur une texture&#xa0;; trouvé&#xa0;: %1</translation>
    </message>
    <message>
        <source>set by hand to a texture, which cannot be: %1</source>
        <translation>réglé à la main sur une texture, ce qui ne se peut pas&#xa0;: %1</translation>
    </message>
    <message>
        <source>Half as wide as narrow kernels</source>
        <translation>Moitié de la largeur des noyaux étroits</translation>
    </message>
    <message>
        <source>A quarter of the mesh; kernels are wide</source>
        <translation>Un quart du maillage&#xa0;; les noyaux sont larges</translation>
    </message>
    <message>
        <source>About one particle a texel</source>
        <translation>Environ une particule par texel</translation>
    </message>
    <message>
        <source>The most light that a texel can hold</source>
        <translation>Le maximum de lumière qu&apos;un texel peut contenir</translation>
    </message>
    <message>
        <source>The memory for textures</source>
        <translation>La mémoire des textures</translation>
    </message>
    <message>
        <source>Set by hand</source>
        <translation>Réglé à la main</translation>
    </message>
    <message>
        <source>Equation 7 of the paper</source>
        <translation>Équation 7 de l&apos;article</translation>
    </message>
    <message>
        <source>Not known</source>
        <translation>Inconnu</translation>
    </message>
    <message>
        <source>spiral</source>
        <translation>spirale</translation>
    </message>
    <message>
        <source>There is no light yet.</source>
        <translation>Il n&apos;y a pas encore de lumière.</translation>
    </message>
    <message>
        <source>No caustics fall on any surface of this scene.</source>
        <translation>Aucune surface de cette scène ne reçoit de caustiques.</translation>
    </message>
    <message>
        <source>The light is still being computed.</source>
        <translation>Le calcul de la lumière est en cours.</translation>
    </message>
    <message>
        <source>1 texture</source>
        <translation>1 texture</translation>
    </message>
    <message>
        <source>%1 textures</source>
        <translation>%1 textures</translation>
    </message>
    <message>
        <source>, %1 · %2 particles sent, %3 landings kept</source>
        <translation>, %1 · %2 particules émises, %3 impacts gardés</translation>
    </message>
    <message>
        <source> · %1 in textures, %2 on the mesh</source>
        <translation> · %1 en textures, %2 sur le maillage</translation>
    </message>
    <message>
        <source>: %1 of the scene&apos;s light</source>
        <translation>&#xa0;: %1 de la lumière de la scène</translation>
    </message>
    <message>
        <source>%1 mm</source>
        <translation>%1 mm</translation>
    </message>
    <message>
        <source>%1 m</source>
        <translation>%1 m</translation>
    </message>
    <message>
        <source>%1 lm</source>
        <translation>%1 lm</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1&#xa0;%</translation>
    </message>
</context>
<context>
    <name>Engine</name>
    <message>
        <source>cannot be opened: %1</source>
        <translation>ne peut pas être ouvert : %1</translation>
    </message>
    <message>
        <source>is not a regular file</source>
        <translation>n&apos;est pas un fichier ordinaire</translation>
    </message>
    <message>
        <source>is larger than %1 MiB</source>
        <translation>dépasse %1 Mio</translation>
    </message>
    <message>
        <source>cannot be read: %1</source>
        <translation>ne peut pas être lu : %1</translation>
    </message>
    <message>
        <source>became shorter while being read</source>
        <translation>a raccourci pendant la lecture</translation>
    </message>
    <message>
        <source>cannot be written: %1</source>
        <translation>ne peut pas être écrit : %1</translation>
    </message>
    <message>
        <source>cannot be replaced: %1</source>
        <translation>ne peut pas être remplacé : %1</translation>
    </message>
    <message>
        <source>could not be written: %1</source>
        <translation>n&apos;a pas pu être écrit : %1</translation>
    </message>
    <message>
        <source>Choose a folder that exists and that you may write to.</source>
        <translation>Choisissez un dossier qui existe et où vous pouvez écrire.</translation>
    </message>
    <message>
        <source>The file that was there before is unchanged.</source>
        <translation>Le fichier précédent est inchangé.</translation>
    </message>
    <message>
        <source>The file that was there before is unchanged. Free some space, or save into another folder.</source>
        <translation>Le fichier précédent est inchangé. Libérez de la place ou enregistrez dans un autre dossier.</translation>
    </message>
    <message>
        <source>&quot;%1&quot; is not a file beside the scene</source>
        <translation>« %1 » n&apos;est pas un fichier placé à côté de la scène</translation>
    </message>
    <message>
        <source>Only relative file names and data: are opened.</source>
        <translation>Seuls les noms de fichier relatifs et data: sont ouverts.</translation>
    </message>
    <message>
        <source>the folder of the scene cannot be read: %1</source>
        <translation>le dossier de la scène ne peut pas être lu : %1</translation>
    </message>
    <message>
        <source>&quot;%1&quot; lies outside the folder of the scene and was not opened</source>
        <translation>« %1 » se trouve hors du dossier de la scène et n&apos;a pas été ouvert</translation>
    </message>
    <message>
        <source>Put the file into the scene&apos;s folder and refer to it by a relative name.</source>
        <translation>Placez le fichier dans le dossier de la scène et désignez-le par un nom relatif.</translation>
    </message>
    <message>
        <source>is not valid glTF: %1</source>
        <translation>n&apos;est pas du glTF valide : %1</translation>
    </message>
    <message>
        <source>Export the file again.</source>
        <translation>Exportez le fichier à nouveau.</translation>
    </message>
    <message>
        <source>there is not enough memory to open the file</source>
        <translation>il n&apos;y a pas assez de mémoire pour ouvrir le fichier</translation>
    </message>
    <message>
        <source>is not a kind of scene file that can be written</source>
        <translation>n&apos;est pas un type de fichier de scène qui puisse être écrit</translation>
    </message>
    <message>
        <source>Name it .atrium, .glb or .gltf.</source>
        <translation>Donnez-lui l&apos;extension .atrium, .glb ou .gltf.</translation>
    </message>
    <message>
        <source>is not at hand</source>
        <translation>est introuvable</translation>
    </message>
    <message>
        <source>Put it beside the scene file, where it was exported.</source>
        <translation>Placez-le à côté du fichier de scène, là où il a été exporté.</translation>
    </message>
    <message>
        <source>not an image of a known format</source>
        <translation>n&apos;est pas une image d&apos;un format connu</translation>
    </message>
    <message>
        <source>the image is empty</source>
        <translation>l&apos;image est vide</translation>
    </message>
    <message>
        <source>Use PNG, JPEG, HDR or EXR.</source>
        <translation>Utilisez PNG, JPEG, HDR ou EXR.</translation>
    </message>
    <message>
        <source>the image cannot be decoded: %1</source>
        <translation>l&apos;image ne peut pas être décodée : %1</translation>
    </message>
    <message>
        <source>the image has no pixels that can be used</source>
        <translation>l&apos;image n&apos;a pas de pixels utilisables</translation>
    </message>
    <message>
        <source>the image is too large: %1 x %2</source>
        <translation>l&apos;image est trop grande : %1 x %2</translation>
    </message>
    <message>
        <source>Scale it down to at most 8192 x 8192.</source>
        <translation>Réduisez-la à 8192 x 8192 au plus.</translation>
    </message>
    <message>
        <source>the image is damaged: %1</source>
        <translation>l&apos;image est endommagée : %1</translation>
    </message>
    <message>
        <source>Surfaces that use it show their plain colour.</source>
        <translation>Les surfaces qui l&apos;utilisent montrent leur couleur unie.</translation>
    </message>
    <message>
        <source>has no image that can be read</source>
        <translation>n&apos;a pas d&apos;image lisible</translation>
    </message>
    <message>
        <source>is neither .exr nor .png</source>
        <translation>n&apos;est ni .exr ni .png</translation>
    </message>
    <message>
        <source>Name the picture .exr or .png.</source>
        <translation>Donnez à l&apos;image l&apos;extension .exr ou .png.</translation>
    </message>
    <message>
        <source>the picture could not be encoded: %1</source>
        <translation>l&apos;image n&apos;a pas pu être encodée : %1</translation>
    </message>
    <message>
        <source>a light of the unknown type &quot;%1&quot; was left out</source>
        <translation>une lumière du type inconnu « %1 » a été omise</translation>
    </message>
    <message>
        <source>Use a point, spot or directional light.</source>
        <translation>Utilisez une lumière ponctuelle, un spot ou une lumière directionnelle.</translation>
    </message>
    <message>
        <source>a colour of %1 was set to 1: with it the light would be too strong</source>
        <translation>une couleur de %1 a été ramenée à 1 : la lumière aurait été trop forte</translation>
    </message>
    <message>
        <source>a height of 0 was set to 1 m</source>
        <translation>une hauteur de 0 a été portée à 1 m</translation>
    </message>
    <message>
        <source>a base colour of %1 was set to %2</source>
        <translation>une couleur de base de %1 a été ramenée à %2</translation>
    </message>
    <message>
        <source>A surface cannot reflect more light than falls on it.</source>
        <translation>Une surface ne peut pas réfléchir plus de lumière qu&apos;elle n&apos;en reçoit.</translation>
    </message>
    <message>
        <source>an emissive strength of %1 was set to 1</source>
        <translation>une émission de %1 a été mise à 1</translation>
    </message>
    <message>
        <source>an emissive strength of %1 was set to %2 cd/m2</source>
        <translation>une émission de %1 a été ramenée à %2 cd/m2</translation>
    </message>
    <message>
        <source>a negative emissive colour was set to 0</source>
        <translation>une couleur d&apos;émission négative a été mise à 0</translation>
    </message>
    <message>
        <source>Light cannot be negative.</source>
        <translation>La lumière ne peut pas être négative.</translation>
    </message>
    <message>
        <source>The sun has 1.6e9 cd/m2.</source>
        <translation>Le soleil a 1,6e9 cd/m2.</translation>
    </message>
    <message>
        <source>an index of refraction of %1 was set to 1.5</source>
        <translation>un indice de réfraction de %1 a été mis à 1,5</translation>
    </message>
    <message>
        <source>It must be at least 1: glass 1.5, water 1.33.</source>
        <translation>Il doit être d&apos;au moins 1 : verre 1,5, eau 1,33.</translation>
    </message>
    <message>
        <source>an attenuation distance that is not positive was ignored</source>
        <translation>une distance d&apos;atténuation qui n&apos;est pas positive a été ignorée</translation>
    </message>
    <message>
        <source>has no positions and is not shown</source>
        <translation>n&apos;a pas de positions et n&apos;est pas montré</translation>
    </message>
    <message>
        <source>has no triangles and is not shown</source>
        <translation>n&apos;a pas de triangles et n&apos;est pas montré</translation>
    </message>
    <message>
        <source>a rotation without direction was left out</source>
        <translation>une rotation sans direction a été omise</translation>
    </message>
    <message>
        <source>a rotation that was not of unit length was normalised</source>
        <translation>une rotation qui n&apos;était pas de longueur unité a été normalisée</translation>
    </message>
    <message>
        <source>the last row of its matrix is not 0 0 0 1 and was replaced by that</source>
        <translation>la dernière ligne de sa matrice n&apos;est pas 0 0 0 1 et a été remplacée par cela</translation>
    </message>
    <message>
        <source>%1 instances became nodes of their own</source>
        <translation>%1 instances sont devenues des nœuds à part entière</translation>
    </message>
    <message>
        <source>the extension %1 is not interpreted</source>
        <translation>l&apos;extension %1 n&apos;est pas interprétée</translation>
    </message>
    <message>
        <source>What it says about materials is kept when saving.</source>
        <translation>Ce qu&apos;elle dit des matériaux est gardé à l&apos;enregistrement.</translation>
    </message>
    <message>
        <source>animations are not played and will not be saved</source>
        <translation>les animations ne sont pas jouées et ne seront pas enregistrées</translation>
    </message>
    <message>
        <source>Lamps that use it shine as plain lights, or not at all.</source>
        <translation>Les lampes qui l&apos;utilisent éclairent comme de simples lumières, ou pas du tout.</translation>
    </message>
    <message>
        <source>is larger than 32 MiB, so it is no photometric file</source>
        <translation>dépasse 32 Mio : ce n&apos;est pas un fichier photométrique</translation>
    </message>
    <message>
        <source>Choose an IES file (LM-63).</source>
        <translation>Choisissez un fichier IES (LM-63).</translation>
    </message>
    <message>
        <source>is no text file</source>
        <translation>n&apos;est pas un fichier texte</translation>
    </message>
    <message>
        <source>Choose an IES file (LM-63), which is plain text.</source>
        <translation>Choisissez un fichier IES (LM-63), qui est du texte brut.</translation>
    </message>
    <message>
        <source>has no TILT= line, so it is no IES photometric file</source>
        <translation>n&apos;a pas de ligne TILT= : ce n&apos;est pas un fichier photométrique IES</translation>
    </message>
    <message>
        <source>Choose an LM-63 file (.ies), or ask the maker of the luminaire for one.</source>
        <translation>Choisissez un fichier LM-63 (.ies) ou demandez-en un au fabricant du luminaire.</translation>
    </message>
    <message>
        <source>all intensities are 0, so there would be no light</source>
        <translation>toutes les intensités sont nulles : il n&apos;y aurait pas de lumière</translation>
    </message>
    <message>
        <source>Choose another file.</source>
        <translation>Choisissez un autre fichier.</translation>
    </message>
    <message>
        <source>is no text file of at most 32 MiB</source>
        <translation>n&apos;est pas un fichier texte de 32 Mio au plus</translation>
    </message>
    <message>
        <source>Choose an EULUMDAT file (.ldt).</source>
        <translation>Choisissez un fichier EULUMDAT (.ldt).</translation>
    </message>
    <message>
        <source>the stored solution has another length than the file says</source>
        <translation>la lumière enregistrée n&apos;a pas la longueur que le fichier indique</translation>
    </message>
    <message>
        <source>the stored solution is damaged</source>
        <translation>la lumière enregistrée est endommagée</translation>
    </message>
    <message>
        <source>it is damaged</source>
        <translation>elle est endommagée</translation>
    </message>
    <message>
        <source>it was written by another version of the program</source>
        <translation>elle a été écrite par une autre version du programme</translation>
    </message>
    <message>
        <source>The light is computed again</source>
        <translation>La lumière est recalculée</translation>
    </message>
    <message>
        <source>stopped before the first picture</source>
        <translation>arrêté avant la première image</translation>
    </message>
    <message>
        <source>Give it more time, or choose draft quality</source>
        <translation>Accordez plus de temps ou choisissez la qualité brouillon</translation>
    </message>
    <message>
        <source>the audit was stopped</source>
        <translation>la mesure de l&apos;erreur a été arrêtée</translation>
    </message>
    <message>
        <source>Give it more time.</source>
        <translation>Accordez plus de temps.</translation>
    </message>
    <message>
        <source>there is nothing to compare: light reaches no surface that scatters it</source>
        <translation>il n&apos;y a rien à comparer : la lumière n&apos;atteint aucune surface qui la diffuse</translation>
    </message>
    <message>
        <source>Add a lamp, daylight or a matt surface.</source>
        <translation>Ajoutez une lampe, la lumière du jour ou une surface mate.</translation>
    </message>
    <message>
        <source>There is not enough memory for the light of this scene.</source>
        <translation>Il n&apos;y a pas assez de mémoire pour la lumière de cette scène.</translation>
    </message>
    <message>
        <source>The light simulation failed: %1</source>
        <translation>La simulation de la lumière a échoué : %1</translation>
    </message>
    <message>
        <source>The light simulation failed for an unknown reason.</source>
        <translation>La simulation de la lumière a échoué pour une raison inconnue.</translation>
    </message>
    <message>
        <source>The light simulation returned no picture.</source>
        <translation>La simulation de la lumière n&apos;a rendu aucune image.</translation>
    </message>
    <message>
        <source>there is no light in it, so everything is black</source>
        <translation>elle ne contient aucune lumière : tout est noir</translation>
    </message>
    <message>
        <source>Add a light, let a material emit, or give the environment a sky</source>
        <translation>Ajoutez une lumière, rendez un matériau lumineux ou donnez un ciel à l&apos;environnement</translation>
    </message>
    <message>
        <source>its scale is zero, so its camera has no direction</source>
        <translation>son échelle est nulle : sa caméra n&apos;a pas de direction</translation>
    </message>
    <message>
        <source>Set the scale to 1</source>
        <translation>Mettez l&apos;échelle à 1</translation>
    </message>
    <message>
        <source>its scale is zero, so it has no volume</source>
        <translation>son échelle est nulle : il n&apos;a pas de volume</translation>
    </message>
    <message>
        <source>Set the scale to 1 or hide the node</source>
        <translation>Mettez l&apos;échelle à 1 ou masquez le nœud</translation>
    </message>
    <message>
        <source>it shows nothing: %1</source>
        <translation>il ne montre rien : %1</translation>
    </message>
    <message>
        <source>Give it a size or delete it</source>
        <translation>Donnez-lui une taille ou supprimez-le</translation>
    </message>
    <message>
        <source>it names more materials than its shape has parts</source>
        <translation>il nomme plus de matériaux que sa forme n&apos;a de parties</translation>
    </message>
    <message>
        <source>The surplus is ignored</source>
        <translation>Le surplus est ignoré</translation>
    </message>
    <message>
        <source>it refers to a texture that does not exist</source>
        <translation>il renvoie à une texture qui n&apos;existe pas</translation>
    </message>
    <message>
        <source>The plain colour stands in</source>
        <translation>La couleur unie la remplace</translation>
    </message>
    <message>
        <source>its %1 of %2 is outside %3 to %4</source>
        <translation>sa valeur %1 de %2 est hors de l&apos;intervalle de %3 à %4</translation>
    </message>
    <message>
        <source>Set it within that range</source>
        <translation>Choisissez une valeur dans cet intervalle</translation>
    </message>
    <message>
        <source>a colour of it is negative</source>
        <translation>une de ses couleurs est négative</translation>
    </message>
    <message>
        <source>Negative light and reflectance count as zero</source>
        <translation>Une lumière ou une réflectance négative compte pour zéro</translation>
    </message>
    <message>
        <source>it reflects %1 % of the light, with which a closed room would grow brighter without end</source>
        <translation>il réfléchit %1 % de la lumière : une pièce fermée deviendrait toujours plus claire</translation>
    </message>
    <message>
        <source>its intensity or colour is negative</source>
        <translation>son intensité ou sa couleur est négative</translation>
    </message>
    <message>
        <source>Negative light counts as none</source>
        <translation>Une lumière négative compte pour nulle</translation>
    </message>
    <message>
        <source>it is switched on but its intensity is zero</source>
        <translation>elle est allumée mais son intensité est nulle</translation>
    </message>
    <message>
        <source>Set an intensity or switch it off</source>
        <translation>Donnez-lui une intensité ou éteignez-la</translation>
    </message>
    <message>
        <source>it has a photometric file, which a sun cannot have</source>
        <translation>elle a un fichier photométrique, ce qu&apos;un soleil ne peut avoir</translation>
    </message>
    <message>
        <source>The file is ignored</source>
        <translation>Le fichier est ignoré</translation>
    </message>
    <message>
        <source>the inner angle of its cone is not smaller than the outer, or that is over 90 degrees</source>
        <translation>l&apos;angle intérieur de son cône n&apos;est pas plus petit que l&apos;angle extérieur, ou celui-ci dépasse 90 degrés</translation>
    </message>
    <message>
        <source>Set 0 &lt;= inner &lt; outer &lt;= 90 degrees</source>
        <translation>Choisissez 0 &lt;= intérieur &lt; extérieur &lt;= 90 degrés</translation>
    </message>
    <message>
        <source>its field of view is not between 0 and 180 degrees</source>
        <translation>son champ de vision n&apos;est pas compris entre 0 et 180 degrés</translation>
    </message>
    <message>
        <source>40 to 70 degrees suit a room</source>
        <translation>40 à 70 degrés conviennent à une pièce</translation>
    </message>
    <message>
        <source>it shows a height of zero</source>
        <translation>elle montre une hauteur nulle</translation>
    </message>
    <message>
        <source>Set its height in metres</source>
        <translation>Donnez sa hauteur en mètres</translation>
    </message>
    <message>
        <source>its far plane is not behind its near plane</source>
        <translation>son plan éloigné n&apos;est pas derrière son plan proche</translation>
    </message>
    <message>
        <source>Set 0 &lt; near &lt; far</source>
        <translation>Choisissez 0 &lt; proche &lt; éloigné</translation>
    </message>
    <message>
        <source>its points lie far from its own origin, where their coordinates have steps of %1 mm</source>
        <translation>ses points sont loin de sa propre origine, là où leurs coordonnées ont des pas de %1 mm</translation>
    </message>
    <message>
        <source>Export it with its origin nearby and move the object instead</source>
        <translation>Exportez-le avec une origine proche et déplacez plutôt l&apos;objet</translation>
    </message>
    <message>
        <source>it has no visible surface</source>
        <translation>elle n&apos;a aucune surface visible</translation>
    </message>
    <message>
        <source>Show a node, or add a shape</source>
        <translation>Montrez un nœud ou ajoutez une forme</translation>
    </message>
    <message>
        <source>it is smaller than a millimetre</source>
        <translation>il est plus petit qu&apos;un millimètre</translation>
    </message>
    <message>
        <source>it and %1 more are smaller than a millimetre</source>
        <translation>lui et %1 autres sont plus petits qu&apos;un millimètre</translation>
    </message>
    <message>
        <source>Such detail costs time and is hardly seen</source>
        <translation>De tels détails coûtent du temps et se voient à peine</translation>
    </message>
    <message>
        <source>there is no such %1</source>
        <translation>cet élément (%1) n&apos;existe pas</translation>
    </message>
    <message>
        <source>It may have been deleted</source>
        <translation>Il a peut-être été supprimé</translation>
    </message>
    <message>
        <source>a size or coordinate is not a finite number</source>
        <translation>une taille ou une coordonnée n&apos;est pas un nombre fini</translation>
    </message>
    <message>
        <source>a value of the material is not a finite number</source>
        <translation>une valeur du matériau n&apos;est pas un nombre fini</translation>
    </message>
    <message>
        <source>it emits more than 1e12 cd/m2</source>
        <translation>il émet plus de 1e12 cd/m2</translation>
    </message>
    <message>
        <source>a value of the light is not a finite number</source>
        <translation>une valeur de la lumière n&apos;est pas un nombre fini</translation>
    </message>
    <message>
        <source>its intensity is more than 1e12</source>
        <translation>son intensité dépasse 1e12</translation>
    </message>
    <message>
        <source>Set it in candela, or in lux for a sun.</source>
        <translation>Donnez-la en candelas, ou en lux pour un soleil.</translation>
    </message>
    <message>
        <source>a value of the camera is not a finite number</source>
        <translation>une valeur de la caméra n&apos;est pas un nombre fini</translation>
    </message>
    <message>
        <source>its position, rotation or scale is not a finite number</source>
        <translation>sa position, sa rotation ou son échelle n&apos;est pas un nombre fini</translation>
    </message>
    <message>
        <source>it cannot be moved below %1, which is part of it</source>
        <translation>il ne peut pas être placé sous %1, qui en fait partie</translation>
    </message>
    <message>
        <source>caustic_textures</source>
        <translation>textures de caustiques</translation>
    </message>
    <message>
        <source>octree</source>
        <translation>octree</translation>
    </message>
    <message>
        <source>refraction</source>
        <translation>réfraction</translation>
    </message>
    <message>
        <source>glossy</source>
        <translation>reflets diffus</translation>
    </message>
    <message>
        <source>direct_layer</source>
        <translation>couche directe</translation>
    </message>
    <message>
        <source>specular_view</source>
        <translation>vue spéculaire</translation>
    </message>
    <message>
        <source>transmittance</source>
        <translation>transmission</translation>
    </message>
    <message>
        <source>alpha_cutouts</source>
        <translation>découpes alpha</translation>
    </message>
    <message>
        <source>photometry</source>
        <translation>photométrie</translation>
    </message>
    <message>
        <source>particles</source>
        <translation>particules</translation>
    </message>
    <message>
        <source>textures</source>
        <translation>textures</translation>
    </message>
    <message>
        <source>sun</source>
        <translation>soleil</translation>
    </message>
    <message>
        <source>sky</source>
        <translation>ciel</translation>
    </message>
    <message>
        <source>There is no specular surface in the scene.</source>
        <translation>Il n&apos;y a aucune surface spéculaire dans la scène.</translation>
    </message>
    <message>
        <source>There is no glass in the scene.</source>
        <translation>Il n&apos;y a pas de verre dans la scène.</translation>
    </message>
    <message>
        <source>All glass is in thin sheets, which light crosses unbent.</source>
        <translation>Tout le verre est en feuilles minces, que la lumière traverse sans être déviée.</translation>
    </message>
    <message>
        <source>There is no mirror, metal or glass in the scene.</source>
        <translation>Il n&apos;y a ni miroir, ni métal, ni verre dans la scène.</translation>
    </message>
    <message>
        <source>Every surface is opaque.</source>
        <translation>Toutes les surfaces sont opaques.</translation>
    </message>
    <message>
        <source>Nothing in the scene gives light.</source>
        <translation>Rien dans la scène ne donne de lumière.</translation>
    </message>
    <message>
        <source>The sky shines with %1 cd/m2.</source>
        <translation>Le ciel brille de %1 cd/m2.</translation>
    </message>
    <message>
        <source>The environment is black.</source>
        <translation>L&apos;environnement est noir.</translation>
    </message>
    <message>
        <source>There is no directional light in the scene.</source>
        <translation>Il n&apos;y a pas de lumière directionnelle dans la scène.</translation>
    </message>
    <message>
        <source>The directional light %1 shines.</source>
        <translation>La lumière directionnelle %1 éclaire.</translation>
    </message>
    <message>
        <source>Made where what particles bring has finer detail than the mesh.</source>
        <translation>Faites là où les particules apportent plus de détail que le maillage.</translation>
    </message>
    <message>
        <source>Nothing is selected to move.</source>
        <translation>Rien n&apos;est choisi pour être déplacé.</translation>
    </message>
    <message>
        <source>There is no glossy metal in the scene.</source>
        <translation>Il n&apos;y a pas de métal satiné dans la scène.</translation>
    </message>
    <message>
        <source>No shown surface has a texture that changes light.</source>
        <translation>Aucune surface visible n&apos;a de texture qui change la lumière.</translation>
    </message>
    <message>
        <source>No surface is cut out by its alpha.</source>
        <translation>Aucune surface n&apos;est découpée par son alpha.</translation>
    </message>
    <message>
        <source>No lamp has a photometric file.</source>
        <translation>Aucune lampe n&apos;a de fichier photométrique.</translation>
    </message>
    <message>
        <source>The file is damaged or incomplete; copy or export it again.</source>
        <translation>Le fichier est endommagé ou incomplet ; copiez-le ou exportez-le à nouveau.</translation>
    </message>
    <message>
        <source>It is damaged or was cut off; get it again from the maker.</source>
        <translation>Il est endommagé ou tronqué ; redemandez-le au fabricant.</translation>
    </message>
    <message>
        <source>holds %1 bytes where the file announces %2</source>
        <translation>contient %1 octets là où le fichier en annonce %2</translation>
    </message>
    <message>
        <source>the file is empty</source>
        <translation>le fichier est vide</translation>
    </message>
    <message>
        <source>is not a glTF file: the JSON text is not an object</source>
        <translation>n&apos;est pas un fichier glTF : le texte JSON n&apos;est pas un objet</translation>
    </message>
    <message>
        <source>is neither glTF text nor a binary glTF file</source>
        <translation>n&apos;est ni du texte glTF ni un fichier glTF binaire</translation>
    </message>
    <message>
        <source>Choose a .gltf, .glb or .atrium file.</source>
        <translation>Choisissez un fichier .gltf, .glb ou .atrium.</translation>
    </message>
    <message>
        <source>the file ends after %1 bytes</source>
        <translation>le fichier s&apos;arrête après %1 octets</translation>
    </message>
    <message>
        <source>its header is cut off</source>
        <translation>son en-tête est tronqué</translation>
    </message>
    <message>
        <source>glTF version &quot;%1&quot; is not supported</source>
        <translation>la version glTF « %1 » n&apos;est pas prise en charge</translation>
    </message>
    <message>
        <source>Export the file as glTF 2.0.</source>
        <translation>Exportez le fichier en glTF 2.0.</translation>
    </message>
    <message>
        <source>This is not a glTF 2.0 file.</source>
        <translation>Ce n&apos;est pas un fichier glTF 2.0.</translation>
    </message>
    <message>
        <source>The file is incomplete; export it again.</source>
        <translation>Le fichier est incomplet ; exportez-le à nouveau.</translation>
    </message>
    <message>
        <source>is missing</source>
        <translation>est absent</translation>
    </message>
    <message>
        <source>&quot;%1&quot; is missing</source>
        <translation>« %1 » est absent</translation>
    </message>
    <message>
        <source>refers to something that the file does not have</source>
        <translation>renvoie à quelque chose que le fichier n&apos;a pas</translation>
    </message>
    <message>
        <source>nothing of the scene&apos;s description can be read</source>
        <translation>rien de la description de la scène ne peut être lu</translation>
    </message>
    <message>
        <source>the scene is larger than 4 GiB, more than one binary glTF file can hold</source>
        <translation>la scène dépasse 4 Gio, plus qu&apos;un fichier glTF binaire ne peut contenir</translation>
    </message>
    <message>
        <source>Save as .gltf.</source>
        <translation>Enregistrez en .gltf.</translation>
    </message>
    <message>
        <source>more_links</source>
        <translation>plus de liens</translation>
    </message>
    <message>
        <source>finer_light_maps</source>
        <translation>cartes de lumière plus fines</translation>
    </message>
    <message>
        <source>more_vertices</source>
        <translation>plus de sommets</translation>
    </message>
    <message>
        <source>more_particles</source>
        <translation>plus de particules</translation>
    </message>
    <message>
        <source>finer_caustic_textures</source>
        <translation>textures de caustiques plus fines</translation>
    </message>
    <message>
        <source>The light may take %1 MiB of memory.</source>
        <translation>La lumière peut prendre %1 Mio de mémoire.</translation>
    </message>
</context>
<context>
    <name>Help</name>
    <message>
        <source>Find a command</source>
        <translation>Chercher une commande</translation>
    </message>
    <message>
        <source>Keyboard Shortcuts</source>
        <translation>Raccourcis clavier</translation>
    </message>
    <message>
        <source>Key</source>
        <translation>Touche</translation>
    </message>
    <message>
        <source>What it does</source>
        <translation>Ce qu&apos;elle fait</translation>
    </message>
    <message>
        <source>Esc</source>
        <translation>Échap</translation>
    </message>
    <message>
        <source>Cancel the drag or the typing; leave walk mode</source>
        <translation>Annuler le geste ou la saisie&#xa0;; quitter la marche</translation>
    </message>
    <message>
        <source>Enter</source>
        <translation>Entrée</translation>
    </message>
    <message>
        <source>Take over the number in a field</source>
        <translation>Valider le nombre d&apos;un champ</translation>
    </message>
    <message>
        <source>Up, Down, wheel</source>
        <translation>Haut, bas, molette</translation>
    </message>
    <message>
        <source>Change the number in the focused field; Shift is finer</source>
        <translation>Changer le nombre du champ actif&#xa0;; Maj pour plus de finesse</translation>
    </message>
    <message>
        <source>About Atrium</source>
        <translation>À propos d&apos;Atrium</translation>
    </message>
    <message>
        <source>Interiors with live global illumination: hierarchical radiosity that follows every edit.

Free software; the licence is in the file LICENSE.</source>
        <translation>Des intérieurs à l&apos;illumination globale en direct&#xa0;: une radiosité hiérarchique qui suit chaque modification.

Logiciel libre&#xa0;; la licence est dans le fichier LICENSE.</translation>
    </message>
</context>
<context>
    <name>Inspection</name>
    <message>
        <source>an object without a name</source>
        <translation>un objet sans nom</translation>
    </message>
    <message>
        <source>%1 m²</source>
        <translation>%1 m²</translation>
    </message>
    <message>
        <source>%1 cm²</source>
        <translation>%1 cm²</translation>
    </message>
    <message>
        <source>Element of %1: small faces, %2</source>
        <translation>Élément de %1 : petites faces, %2</translation>
    </message>
    <message>
        <source>Element of %1: level %2, %3</source>
        <translation>Élément de %1 : niveau %2, %3</translation>
    </message>
    <message>
        <source>%1 links bring %2 lx of %3 lx (%4 %)</source>
        <translation>%1 liens apportent %2 lx sur %3 lx (%4 %)</translation>
    </message>
    <message>
        <source>Straight from lamps, sun and sky %1 lx, over mirrors and glass %2 lx</source>
        <translation>Directement des lampes, du soleil et du ciel %1 lx, par les miroirs et les verres %2 lx</translation>
    </message>
    <message>
        <source>Strongest link: %1, %2 lx (%3 % of all links)</source>
        <translation>Lien le plus fort : %1, %2 lx (%3 % de tous les liens)</translation>
    </message>
    <message>
        <source>Link under the cursor: %1, %2 lx (%3 %)</source>
        <translation>Lien sous le curseur : %1, %2 lx (%3 %)</translation>
    </message>
    <message>
        <source>No particles: no light that stands out goes over a mirror or glass</source>
        <translation>Pas de particules : aucune lumière marquante ne passe par un miroir ou un verre</translation>
    </message>
    <message>
        <source>No particles landed on the selection or went over it</source>
        <translation>Aucune particule n&apos;est arrivée sur la sélection ni passée par elle</translation>
    </message>
    <message>
        <source>Ways of %1 particles of the selection, of %2 in all</source>
        <translation>Trajets de %1 particules de la sélection, sur %2 en tout</translation>
    </message>
    <message>
        <source>Ways of %1 particles, of %2 in all</source>
        <translation>Trajets de %1 particules, sur %2 en tout</translation>
    </message>
    <message>
        <source>Blue to red: %1 to %2 lm each</source>
        <translation>Du bleu au rouge : de %1 à %2 lm chacune</translation>
    </message>
    <message>
        <source>Passage octree: %1 cells</source>
        <translation>Octree de passage : %1 cellules</translation>
    </message>
    <message>
        <source>Passage octree: none, touched particles are found by a scan</source>
        <translation>Octree de passage : aucun, les particules touchées sont trouvées par un parcours</translation>
    </message>
    <message>
        <source>Last update, %1 ms, changed:</source>
        <translation>Dernière mise à jour, %1 ms, a changé :</translation>
    </message>
    <message>
        <source>%1 of %2 texels (red)</source>
        <translation>%1 texels sur %2 (rouge)</translation>
    </message>
    <message>
        <source>%1 of %2 vertices (blue)</source>
        <translation>%1 sommets sur %2 (bleu)</translation>
    </message>
    <message>
        <source>%1 of %2 caustic textures (pink)</source>
        <translation>%1 textures de caustiques sur %2 (rose)</translation>
    </message>
    <message>
        <source>Elements and links come with the complete light</source>
        <translation>Les éléments et les liens viennent avec la lumière complète</translation>
    </message>
    <message>
        <source>%1 elements</source>
        <translation>%1 éléments</translation>
    </message>
    <message>
        <source>%1 elements of the selection</source>
        <translation>%1 éléments de la sélection</translation>
    </message>
    <message>
        <source>Click a surface to see the links of its element</source>
        <translation>Cliquer sur une surface pour voir les liens de son élément</translation>
    </message>
    <message>
        <source>Measuring the error ...</source>
        <translation>Mesure de l&apos;erreur ...</translation>
    </message>
    <message>
        <source>Likely error (rms) from %1 measured places, %2 % over all</source>
        <translation>Erreur probable (quadratique moyenne) d&apos;après %1 points mesurés, %2 % sur l&apos;ensemble</translation>
    </message>
    <message>
        <source>Every place: from the %1 most like it, by position, direction and light</source>
        <translation>Chaque point : d&apos;après les %1 qui lui ressemblent le plus, par position, orientation et lumière</translation>
    </message>
    <message>
        <source>The error is measured when the light is complete</source>
        <translation>L&apos;erreur est mesurée quand la lumière est complète</translation>
    </message>
    <message>
        <source>The histogram stands beside the legend of illuminance (F6) and luminance (F7)</source>
        <translation>L&apos;histogramme se trouve à côté de la légende de l&apos;éclairement (F6) et de la luminance (F7)</translation>
    </message>
    <message>
        <source>All surfaces: mean %1 %2, median %3, nine tenths between %4 and %5</source>
        <translation>Toutes les surfaces : moyenne %1 %2, médiane %3, neuf dixièmes entre %4 et %5</translation>
    </message>
    <message>
        <source>Selection: mean %1 %2, median %3, nine tenths between %4 and %5</source>
        <translation>Sélection : moyenne %1 %2, médiane %3, neuf dixièmes entre %4 et %5</translation>
    </message>
    <message>
        <source>Move something to see what the update changes</source>
        <translation>Déplacer quelque chose pour voir ce que la mise à jour change</translation>
    </message>
    <message>
        <source>Error
%</source>
        <translation>Erreur
%</translation>
    </message>
    <message>
        <source>Subdivision
level</source>
        <translation>Niveau de
subdivision</translation>
    </message>
    <message>
        <source>Link density
1/m²</source>
        <translation>Densité des liens
1/m²</translation>
    </message>
    <message>
        <source>Select an object to see the octree around it</source>
        <translation>Sélectionnez un objet pour voir l&apos;octree qui l&apos;entoure</translation>
    </message>
    <message>
        <source>Octree: the selection has no surfaces in the light</source>
        <translation>Octree : la sélection n&apos;a pas de surface dans la lumière</translation>
    </message>
    <message>
        <source>Octree: %1 cells around the selection, blue to red by particles</source>
        <translation>Octree : %1 cellules autour de la sélection, du bleu au rouge selon les particules</translation>
    </message>
    <message>
        <source>%1 of %2 particles cross its bounds and would be sent anew by a move</source>
        <translation>%1 particules sur %2 traversent son enveloppe et seraient émises de nouveau par un déplacement</translation>
    </message>
</context>
<context>
    <name>Legend</name>
    <message>
        <source>Illuminance</source>
        <translation>Éclairement</translation>
    </message>
    <message>
        <source>Luminance</source>
        <translation>Luminance</translation>
    </message>
</context>
<context>
    <name>Library</name>
    <message>
        <source>White paint, LRV 90</source>
        <translation>Peinture blanche, LRV 90</translation>
    </message>
    <message>
        <source>Brilliant white, matt emulsion</source>
        <translation>Blanc brillant, émulsion mate</translation>
    </message>
    <message>
        <source>Warm white paint, LRV 84</source>
        <translation>Peinture blanc chaud, LRV 84</translation>
    </message>
    <message>
        <source>Off-white walls, as RAL 9010</source>
        <translation>Murs blanc cassé, comme RAL 9010</translation>
    </message>
    <message>
        <source>Light grey paint, LRV 70</source>
        <translation>Peinture gris clair, LRV 70</translation>
    </message>
    <message>
        <source>Usual assumption for ceilings in lighting calculations</source>
        <translation>Hypothèse usuelle pour les plafonds en calcul d&apos;éclairage</translation>
    </message>
    <message>
        <source>Grey paint, LRV 50</source>
        <translation>Peinture grise, LRV 50</translation>
    </message>
    <message>
        <source>Usual assumption for walls in lighting calculations</source>
        <translation>Hypothèse usuelle pour les murs en calcul d&apos;éclairage</translation>
    </message>
    <message>
        <source>Mid grey paint, LRV 20</source>
        <translation>Peinture gris moyen, LRV 20</translation>
    </message>
    <message>
        <source>Usual assumption for floors in lighting calculations</source>
        <translation>Hypothèse usuelle pour les sols en calcul d&apos;éclairage</translation>
    </message>
    <message>
        <source>Anthracite paint, LRV 8</source>
        <translation>Peinture anthracite, LRV 8</translation>
    </message>
    <message>
        <source>As RAL 7016</source>
        <translation>Comme RAL 7016</translation>
    </message>
    <message>
        <source>Black paint, LRV 5</source>
        <translation>Peinture noire, LRV 5</translation>
    </message>
    <message>
        <source>Matt black</source>
        <translation>Noir mat</translation>
    </message>
    <message>
        <source>Cream paint, LRV 75</source>
        <translation>Peinture crème, LRV 75</translation>
    </message>
    <message>
        <source>Light yellow wall paint</source>
        <translation>Peinture murale jaune clair</translation>
    </message>
    <message>
        <source>Sage green paint, LRV 45</source>
        <translation>Peinture vert sauge, LRV 45</translation>
    </message>
    <message>
        <source>Muted green wall paint</source>
        <translation>Peinture murale vert doux</translation>
    </message>
    <message>
        <source>Blue paint, LRV 30</source>
        <translation>Peinture bleue, LRV 30</translation>
    </message>
    <message>
        <source>Mid blue wall paint</source>
        <translation>Peinture murale bleu moyen</translation>
    </message>
    <message>
        <source>Terracotta paint, LRV 22</source>
        <translation>Peinture terre cuite, LRV 22</translation>
    </message>
    <message>
        <source>Red-brown wall paint</source>
        <translation>Peinture murale brun-rouge</translation>
    </message>
    <message>
        <source>Gypsum plaster, LRV 80</source>
        <translation>Plâtre, LRV 80</translation>
    </message>
    <message>
        <source>Fresh, unpainted</source>
        <translation>Frais, non peint</translation>
    </message>
    <message>
        <source>Concrete, LRV 30</source>
        <translation>Béton, LRV 30</translation>
    </message>
    <message>
        <source>Fair-faced, light grey</source>
        <translation>Parement lisse, gris clair</translation>
    </message>
    <message>
        <source>Red brick, LRV 18</source>
        <translation>Brique rouge, LRV 18</translation>
    </message>
    <message>
        <source>Facing brick</source>
        <translation>Brique de parement</translation>
    </message>
    <message>
        <source>Oak, LRV 35</source>
        <translation>Chêne, LRV 35</translation>
    </message>
    <message>
        <source>Oiled oak floor or furniture</source>
        <translation>Sol ou meuble en chêne huilé</translation>
    </message>
    <message>
        <source>Maple, LRV 55</source>
        <translation>Érable, LRV 55</translation>
    </message>
    <message>
        <source>Light wood, varnished</source>
        <translation>Bois clair, verni</translation>
    </message>
    <message>
        <source>Walnut, LRV 12</source>
        <translation>Noyer, LRV 12</translation>
    </message>
    <message>
        <source>Dark wood, oiled</source>
        <translation>Bois foncé, huilé</translation>
    </message>
    <message>
        <source>Grey carpet, LRV 15</source>
        <translation>Moquette grise, LRV 15</translation>
    </message>
    <message>
        <source>Loop pile</source>
        <translation>Bouclée</translation>
    </message>
    <message>
        <source>Beige carpet, LRV 35</source>
        <translation>Moquette beige, LRV 35</translation>
    </message>
    <message>
        <source>Cut pile</source>
        <translation>Velours</translation>
    </message>
    <message>
        <source>Linen, LRV 50</source>
        <translation>Lin, LRV 50</translation>
    </message>
    <message>
        <source>Natural upholstery fabric</source>
        <translation>Tissu d&apos;ameublement naturel</translation>
    </message>
    <message>
        <source>White tile, LRV 80</source>
        <translation>Carrelage blanc, LRV 80</translation>
    </message>
    <message>
        <source>Glazed ceramic</source>
        <translation>Céramique émaillée</translation>
    </message>
    <message>
        <source>Light marble, LRV 60</source>
        <translation>Marbre clair, LRV 60</translation>
    </message>
    <message>
        <source>Honed</source>
        <translation>Adouci</translation>
    </message>
    <message>
        <source>Brushed aluminium, 75 %</source>
        <translation>Aluminium brossé, 75&#xa0;%</translation>
    </message>
    <message>
        <source>Scatters what it reflects</source>
        <translation>Disperse ce qu&apos;il réfléchit</translation>
    </message>
    <message>
        <source>Brushed stainless steel, 58 %</source>
        <translation>Inox brossé, 58&#xa0;%</translation>
    </message>
    <message>
        <source>Polished chrome, 65 %</source>
        <translation>Chrome poli, 65&#xa0;%</translation>
    </message>
    <message>
        <source>Reflects like a mirror; throws caustics</source>
        <translation>Réfléchit comme un miroir&#xa0;; projette des caustiques</translation>
    </message>
    <message>
        <source>Polished brass, 72 %</source>
        <translation>Laiton poli, 72&#xa0;%</translation>
    </message>
    <message>
        <source>Polished copper, 68 %</source>
        <translation>Cuivre poli, 68&#xa0;%</translation>
    </message>
    <message>
        <source>Mirror, 90 %</source>
        <translation>Miroir, 90&#xa0;%</translation>
    </message>
    <message>
        <source>Silvered glass</source>
        <translation>Verre argenté</translation>
    </message>
    <message>
        <source>Clear glass, pane</source>
        <translation>Verre clair, vitre</translation>
    </message>
    <message>
        <source>Float glass as a thin pane: lets some 90 % through</source>
        <translation>Verre flotté en vitre mince&#xa0;: laisse passer environ 90&#xa0;%</translation>
    </message>
    <message>
        <source>Clear glass, solid</source>
        <translation>Verre clair, massif</translation>
    </message>
    <message>
        <source>For closed bodies: bends light and throws caustics</source>
        <translation>Pour des corps fermés&#xa0;: dévie la lumière et projette des caustiques</translation>
    </message>
    <message>
        <source>Frosted glass, pane</source>
        <translation>Verre dépoli, vitre</translation>
    </message>
    <message>
        <source>Acid-etched: lets light through and scatters it</source>
        <translation>Dépoli à l&apos;acide&#xa0;: laisse passer la lumière et la disperse</translation>
    </message>
    <message>
        <source>Lamp shade</source>
        <translation>Abat-jour</translation>
    </message>
    <message>
        <source>Lamp metal</source>
        <translation>Métal de lampe</translation>
    </message>
    <message>
        <source>Wax</source>
        <translation>Cire</translation>
    </message>
    <message>
        <source>Canvas</source>
        <translation>Toile</translation>
    </message>
    <message>
        <source>Box</source>
        <translation>Boîte</translation>
    </message>
    <message>
        <source>0.5 m</source>
        <translation>0,5 m</translation>
    </message>
    <message>
        <source>Sphere</source>
        <translation>Sphère</translation>
    </message>
    <message>
        <source>0.5 m across</source>
        <translation>0,5 m de diamètre</translation>
    </message>
    <message>
        <source>Cylinder</source>
        <translation>Cylindre</translation>
    </message>
    <message>
        <source>0.5 m across, 0.75 m high</source>
        <translation>0,5 m de diamètre, 0,75 m de haut</translation>
    </message>
    <message>
        <source>Cone</source>
        <translation>Cône</translation>
    </message>
    <message>
        <source>Wall piece</source>
        <translation>Pan de mur</translation>
    </message>
    <message>
        <source>2 m long, 2.5 m high, 12 cm thick</source>
        <translation>2 m de long, 2,5 m de haut, 12 cm d&apos;épaisseur</translation>
    </message>
    <message>
        <source>Panel</source>
        <translation>Panneau</translation>
    </message>
    <message>
        <source>1 m x 2 m, 2 cm thick, lies on the surface</source>
        <translation>1 m x 2 m, 2 cm d&apos;épaisseur, posé sur la surface</translation>
    </message>
    <message>
        <source>Rug</source>
        <translation>Tapis</translation>
    </message>
    <message>
        <source>2 m x 1.4 m</source>
        <translation>2 m x 1,4 m</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>Tableau</translation>
    </message>
    <message>
        <source>60 cm x 80 cm, framed, turns with the wall</source>
        <translation>60 cm x 80 cm, encadré, tourne avec le mur</translation>
    </message>
    <message>
        <source>Wall mirror</source>
        <translation>Miroir mural</translation>
    </message>
    <message>
        <source>60 cm x 120 cm</source>
        <translation>60 cm x 120 cm</translation>
    </message>
    <message>
        <source>Pendant globe, 1000 lm, 2700 K</source>
        <translation>Suspension globe, 1000 lm, 2700 K</translation>
    </message>
    <message>
        <source>Opal glass, 24 cm, hangs 70 cm below the ceiling</source>
        <translation>Verre opale, 24 cm, à 70 cm sous le plafond</translation>
    </message>
    <message>
        <source>Pendant with shade, 800 lm, 2700 K</source>
        <translation>Suspension à abat-jour, 800 lm, 2700 K</translation>
    </message>
    <message>
        <source>Shines down over a table, 80 cm below the ceiling</source>
        <translation>Éclaire vers le bas au-dessus d&apos;une table, à 80 cm sous le plafond</translation>
    </message>
    <message>
        <source>Ceiling light, 2000 lm, 3000 K</source>
        <translation>Plafonnier, 2000 lm, 3000 K</translation>
    </message>
    <message>
        <source>Flat opal disc, 40 cm</source>
        <translation>Disque opale plat, 40 cm</translation>
    </message>
    <message>
        <source>Downlight, 700 lm, 3000 K, 60°</source>
        <translation>Downlight, 700 lm, 3000 K, 60°</translation>
    </message>
    <message>
        <source>Surface-mounted, medium beam</source>
        <translation>En saillie, faisceau moyen</translation>
    </message>
    <message>
        <source>Spot, 500 lm, 3000 K, 24°</source>
        <translation>Spot, 500 lm, 3000 K, 24°</translation>
    </message>
    <message>
        <source>Narrow beam for pictures and accents; turn it with the rotate tool</source>
        <translation>Faisceau étroit pour tableaux et accents&#xa0;; à orienter avec l&apos;outil de rotation</translation>
    </message>
    <message>
        <source>Linear light, 3600 lm, 4000 K</source>
        <translation>Réglette, 3600 lm, 4000 K</translation>
    </message>
    <message>
        <source>120 cm x 6 cm office luminaire</source>
        <translation>Luminaire de bureau de 120 cm x 6 cm</translation>
    </message>
    <message>
        <source>LED panel, 3400 lm, 4000 K</source>
        <translation>Dalle LED, 3400 lm, 4000 K</translation>
    </message>
    <message>
        <source>60 cm x 60 cm</source>
        <translation>60 cm x 60 cm</translation>
    </message>
    <message>
        <source>Wall light, 600 lm, 2700 K</source>
        <translation>Applique, 600 lm, 2700 K</translation>
    </message>
    <message>
        <source>Opal half of a globe on a plate</source>
        <translation>Demi-globe opale sur une platine</translation>
    </message>
    <message>
        <source>Table lamp, 470 lm, 2700 K</source>
        <translation>Lampe de table, 470 lm, 2700 K</translation>
    </message>
    <message>
        <source>Shade of 28 cm, 45 cm high</source>
        <translation>Abat-jour de 28 cm, 45 cm de haut</translation>
    </message>
    <message>
        <source>Floor lamp, 1500 lm, 2700 K</source>
        <translation>Lampadaire, 1500 lm, 2700 K</translation>
    </message>
    <message>
        <source>1.6 m high, shade of 40 cm</source>
        <translation>1,6 m de haut, abat-jour de 40 cm</translation>
    </message>
    <message>
        <source>Uplighter, 3000 lm, 3000 K</source>
        <translation>Lampadaire indirect, 3000 lm, 3000 K</translation>
    </message>
    <message>
        <source>1.8 m high, shines to the ceiling</source>
        <translation>1,8 m de haut, éclaire le plafond</translation>
    </message>
    <message>
        <source>Candle, 13 lm, 1900 K</source>
        <translation>Bougie, 13 lm, 1900 K</translation>
    </message>
    <message>
        <source>One candela, 20 cm high</source>
        <translation>Une candela, 20 cm de haut</translation>
    </message>
    <message>
        <source>Dining table</source>
        <translation>Table à manger</translation>
    </message>
    <message>
        <source>Oak, 180 cm x 90 cm, for six to eight</source>
        <translation>Chêne, 180 cm x 90 cm, pour six à huit personnes</translation>
    </message>
    <message>
        <source>Round table</source>
        <translation>Table ronde</translation>
    </message>
    <message>
        <source>White lacquer, 110 cm across</source>
        <translation>Laque blanche, 110 cm de diamètre</translation>
    </message>
    <message>
        <source>Coffee table</source>
        <translation>Table basse</translation>
    </message>
    <message>
        <source>Walnut and steel, 110 cm x 60 cm</source>
        <translation>Noyer et acier, 110 cm x 60 cm</translation>
    </message>
    <message>
        <source>Desk</source>
        <translation>Bureau</translation>
    </message>
    <message>
        <source>Oak with a drawer, 140 cm x 70 cm</source>
        <translation>Chêne, avec un tiroir, 140 cm x 70 cm</translation>
    </message>
    <message>
        <source>Chair</source>
        <translation>Chaise</translation>
    </message>
    <message>
        <source>Oak, seat 46 cm high</source>
        <translation>Chêne, assise à 46 cm</translation>
    </message>
    <message>
        <source>Bar stool</source>
        <translation>Tabouret de bar</translation>
    </message>
    <message>
        <source>Walnut and steel, 66 cm high</source>
        <translation>Noyer et acier, 66 cm de haut</translation>
    </message>
    <message>
        <source>Bench</source>
        <translation>Banc</translation>
    </message>
    <message>
        <source>Oak and steel, 140 cm long</source>
        <translation>Chêne et acier, 140 cm de long</translation>
    </message>
    <message>
        <source>Armchair</source>
        <translation>Fauteuil</translation>
    </message>
    <message>
        <source>Ochre wool, 74 cm wide</source>
        <translation>Laine ocre, 74 cm de large</translation>
    </message>
    <message>
        <source>Sofa</source>
        <translation>Canapé</translation>
    </message>
    <message>
        <source>Grey wool, 210 cm wide, for three</source>
        <translation>Laine grise, 210 cm de large, trois places</translation>
    </message>
    <message>
        <source>Double bed</source>
        <translation>Lit double</translation>
    </message>
    <message>
        <source>Oak, mattress 160 cm x 200 cm</source>
        <translation>Chêne, matelas 160 cm x 200 cm</translation>
    </message>
    <message>
        <source>Bedside table</source>
        <translation>Table de chevet</translation>
    </message>
    <message>
        <source>White lacquer, 45 cm wide</source>
        <translation>Laque blanche, 45 cm de large</translation>
    </message>
    <message>
        <source>Bookcase</source>
        <translation>Bibliothèque</translation>
    </message>
    <message>
        <source>Oak, 90 cm wide, 190 cm high, with books</source>
        <translation>Chêne, 90 cm de large, 190 cm de haut, avec des livres</translation>
    </message>
    <message>
        <source>Sideboard</source>
        <translation>Buffet</translation>
    </message>
    <message>
        <source>Walnut, 160 cm wide</source>
        <translation>Noyer, 160 cm de large</translation>
    </message>
    <message>
        <source>Wardrobe</source>
        <translation>Armoire</translation>
    </message>
    <message>
        <source>White lacquer, 120 cm wide, 208 cm high</source>
        <translation>Laque blanche, 120 cm de large, 208 cm de haut</translation>
    </message>
    <message>
        <source>Potted plant</source>
        <translation>Plante en pot</translation>
    </message>
    <message>
        <source>One metre high, in a clay pot</source>
        <translation>Un mètre de haut, en pot de terre cuite</translation>
    </message>
    <message>
        <source>Bowl</source>
        <translation>Bol</translation>
    </message>
    <message>
        <source>Porcelain, 28 cm across</source>
        <translation>Porcelaine, 28 cm de diamètre</translation>
    </message>
    <message>
        <source>Glass vase</source>
        <translation>Vase en verre</translation>
    </message>
    <message>
        <source>Solid clear glass, 26 cm high: throws caustics</source>
        <translation>Verre clair massif, 26 cm de haut : projette des caustiques</translation>
    </message>
</context>
<context>
    <name>LightMeter</name>
    <message>
        <source>%1 lx ± %2</source>
        <translation>%1 lx ± %2</translation>
    </message>
    <message>
        <source>%1 lx</source>
        <translation>%1 lx</translation>
    </message>
    <message>
        <source>%1 cd/m²</source>
        <translation>%1 cd/m²</translation>
    </message>
    <message>
        <source>direct %1 %, diffuse %2 %, caustics %3 %</source>
        <translation>directe %1&#xa0;%, diffuse %2&#xa0;%, caustiques %3&#xa0;%</translation>
    </message>
</context>
<context>
    <name>LightShares</name>
    <message>
        <source>direct light</source>
        <translation>lumière directe</translation>
    </message>
    <message>
        <source>diffuse light</source>
        <translation>lumière diffuse</translation>
    </message>
    <message>
        <source>caustics</source>
        <translation>caustiques</translation>
    </message>
    <message>
        <source>, </source>
        <comment>between items of a list</comment>
        <translation>, </translation>
    </message>
</context>
<context>
    <name>MeasureTool</name>
    <message>
        <source>Light is measured on matt surfaces, once there is some.</source>
        <translation>La lumière se mesure sur des surfaces mates, une fois qu&apos;il y en a.</translation>
    </message>
</context>
<context>
    <name>ProjectLock</name>
    <message>
        <source>another program</source>
        <translation>un autre programme</translation>
    </message>
    <message>
        <source>process %1 on %2</source>
        <translation>le processus %1 sur %2</translation>
    </message>
</context>
<context>
    <name>QColorDialog</name>
    <message>
        <source>Select Color</source>
        <translation>Choisir une couleur</translation>
    </message>
    <message>
        <source>&amp;Basic colors</source>
        <translation>Couleurs de &amp;base</translation>
    </message>
    <message>
        <source>&amp;Custom colors</source>
        <translation>&amp;Couleurs personnalisées</translation>
    </message>
    <message>
        <source>&amp;Add to Custom Colors</source>
        <translation>&amp;Ajouter aux couleurs personnalisées</translation>
    </message>
    <message>
        <source>&amp;Pick Screen Color</source>
        <translation>&amp;Prélever une couleur à l&apos;écran</translation>
    </message>
    <message>
        <source>Hu&amp;e:</source>
        <translation>&amp;Teinte&#xa0;:</translation>
    </message>
    <message>
        <source>&amp;Sat:</source>
        <translation>&amp;Sat.&#xa0;:</translation>
    </message>
    <message>
        <source>&amp;Val:</source>
        <translation>&amp;Val.&#xa0;:</translation>
    </message>
    <message>
        <source>&amp;Red:</source>
        <translation>&amp;Rouge&#xa0;:</translation>
    </message>
    <message>
        <source>&amp;Green:</source>
        <translation>&amp;Vert&#xa0;:</translation>
    </message>
    <message>
        <source>Bl&amp;ue:</source>
        <translation>Bl&amp;eu&#xa0;:</translation>
    </message>
    <message>
        <source>&amp;HTML:</source>
        <translation>&amp;HTML&#xa0;:</translation>
    </message>
</context>
<context>
    <name>QDialogButtonBox</name>
    <message>
        <source>OK</source>
        <translation>OK</translation>
    </message>
</context>
<context>
    <name>QFileDialog</name>
    <message>
        <source>Look in:</source>
        <translation>Regarder dans&#xa0;:</translation>
    </message>
    <message>
        <source>File &amp;name:</source>
        <translation>&amp;Nom du fichier&#xa0;:</translation>
    </message>
    <message>
        <source>Files of type:</source>
        <translation>Fichiers de type&#xa0;:</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Précédent</translation>
    </message>
    <message>
        <source>Forward</source>
        <translation>Suivant</translation>
    </message>
    <message>
        <source>Parent Directory</source>
        <translation>Dossier parent</translation>
    </message>
    <message>
        <source>Create New Folder</source>
        <translation>Créer un nouveau dossier</translation>
    </message>
    <message>
        <source>List View</source>
        <translation>Vue en liste</translation>
    </message>
    <message>
        <source>Detail View</source>
        <translation>Vue détaillée</translation>
    </message>
    <message>
        <source>&amp;Open</source>
        <translation>&amp;Ouvrir</translation>
    </message>
    <message>
        <source>&amp;Save</source>
        <translation>&amp;Enregistrer</translation>
    </message>
    <message>
        <source>&amp;Choose</source>
        <translation>&amp;Choisir</translation>
    </message>
    <message>
        <source>Directory:</source>
        <translation>Dossier&#xa0;:</translation>
    </message>
    <message>
        <source>All Files (*)</source>
        <translation>Tous les fichiers (*)</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Ouvrir</translation>
    </message>
    <message>
        <source>Save As</source>
        <translation>Enregistrer sous</translation>
    </message>
    <message>
        <source>&amp;Rename</source>
        <translation>&amp;Renommer</translation>
    </message>
    <message>
        <source>&amp;Delete</source>
        <translation>&amp;Supprimer</translation>
    </message>
    <message>
        <source>Show &amp;hidden files</source>
        <translation>Afficher les fic&amp;hiers cachés</translation>
    </message>
    <message>
        <source>&amp;New Folder</source>
        <translation>&amp;Nouveau dossier</translation>
    </message>
    <message>
        <source>New Folder</source>
        <translation>Nouveau dossier</translation>
    </message>
    <message>
        <source>%1 already exists.
Do you want to replace it?</source>
        <translation>%1 existe déjà.
Voulez-vous le remplacer&#xa0;?</translation>
    </message>
    <message>
        <source>%1
File not found.
Please verify the correct file name was given.</source>
        <translation>%1
Fichier introuvable.
Vérifiez que le nom du fichier est correct.</translation>
    </message>
</context>
<context>
    <name>QFileSystemModel</name>
    <message>
        <source>Name</source>
        <translation>Nom</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Taille</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Type</translation>
    </message>
    <message>
        <source>Type</source>
        <translation>Type</translation>
    </message>
    <message>
        <source>Date Modified</source>
        <translation>Modifié le</translation>
    </message>
</context>
<context>
    <name>QMessageBox</name>
    <message>
        <source>Show Details...</source>
        <translation>Afficher les détails...</translation>
    </message>
    <message>
        <source>Hide Details...</source>
        <translation>Masquer les détails...</translation>
    </message>
</context>
<context>
    <name>QObject</name>
    <message>
        <source>%1 s</source>
        <translation>%1 s</translation>
    </message>
    <message>
        <source>%1 %</source>
        <translation>%1&#xa0;%</translation>
    </message>
    <message>
        <source>%1 lm</source>
        <translation>%1 lm</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>oui</translation>
    </message>
    <message>
        <source>no</source>
        <translation>non</translation>
    </message>
    <message>
        <source>%1 min %2 s</source>
        <translation>%1 min %2 s</translation>
    </message>
    <message>
        <source>%1: the picture could not be written</source>
        <translation>%1&#xa0;: l&apos;image n&apos;a pas pu être écrite</translation>
    </message>
    <message>
        <source>Edit interiors with live global illumination.</source>
        <translation>Composer des intérieurs à l&apos;illumination globale en direct.</translation>
    </message>
    <message>
        <source>scene to open: .gltf, .glb or .atrium</source>
        <translation>scène à ouvrir&#xa0;: .gltf, .glb ou .atrium</translation>
    </message>
    <message>
        <source>open, wait for the light, save a picture of the window, quit</source>
        <translation>ouvrir, attendre la lumière, enregistrer une image de la fenêtre, quitter</translation>
    </message>
    <message>
        <source>wait at most this long for the light</source>
        <translation>attendre la lumière au plus ce temps</translation>
    </message>
    <message>
        <source>size of the window in points</source>
        <translation>taille de la fenêtre en points</translation>
    </message>
    <message>
        <source>open the sample room</source>
        <translation>ouvrir la pièce d&apos;exemple</translation>
    </message>
    <message>
        <source>select the node of this name</source>
        <translation>sélectionner le nœud de ce nom</translation>
    </message>
    <message>
        <source>bring a panel to the front: library, tree, properties, jobs, problems, caustics, convergence; none puts all away</source>
        <translation>mettre un panneau au premier plan&#xa0;: library, tree, properties, jobs, problems, caustics, convergence&#xa0;; none les range tous</translation>
    </message>
    <message>
        <source>run a command of the menus by its name (caustic_boxes, wireframe, ...) once the file is open; may be repeated</source>
        <translation>exécuter une commande des menus par son nom (caustic_boxes, wireframe, ...) une fois le fichier ouvert&#xa0;; peut se répéter</translation>
    </message>
    <message>
        <source>with --screenshot: put a measuring point at this place of the view, in shares of its width and height; may be repeated</source>
        <translation>avec --screenshot&#xa0;: poser un point de mesure à cet endroit de la vue, en fractions de sa largeur et de sa hauteur&#xa0;; peut se répéter</translation>
    </message>
    <message>
        <source>with --screenshot and --command element_links: show the links of the element at this place of the view, in shares of its width and height</source>
        <translation>avec --screenshot et --command element_links : montrer les liens de l&apos;élément à cet endroit de la vue, en parts de sa largeur et de sa hauteur</translation>
    </message>
</context>
<context>
    <name>QPlatformTheme</name>
    <message>
        <source>OK</source>
        <translation>OK</translation>
    </message>
    <message>
        <source>Save</source>
        <translation>Enregistrer</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Annuler</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Fermer</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Ne pas enregistrer</translation>
    </message>
    <message>
        <source>&amp;Yes</source>
        <translation>&amp;Oui</translation>
    </message>
    <message>
        <source>&amp;No</source>
        <translation>&amp;Non</translation>
    </message>
    <message>
        <source>Apply</source>
        <translation>Appliquer</translation>
    </message>
    <message>
        <source>Reset</source>
        <translation>Réinitialiser</translation>
    </message>
    <message>
        <source>Help</source>
        <translation>Aide</translation>
    </message>
    <message>
        <source>Don&apos;t Save</source>
        <translation>Ne pas enregistrer</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Ouvrir</translation>
    </message>
    <message>
        <source>Restore Defaults</source>
        <translation>Valeurs par défaut</translation>
    </message>
    <message>
        <source>Abort</source>
        <translation>Abandonner</translation>
    </message>
    <message>
        <source>Retry</source>
        <translation>Réessayer</translation>
    </message>
    <message>
        <source>Ignore</source>
        <translation>Ignorer</translation>
    </message>
</context>
<context>
    <name>QWidgetTextControl</name>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Annuler</translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation>&amp;Rétablir</translation>
    </message>
    <message>
        <source>Cu&amp;t</source>
        <translation>Co&amp;uper</translation>
    </message>
    <message>
        <source>&amp;Copy</source>
        <translation>&amp;Copier</translation>
    </message>
    <message>
        <source>&amp;Paste</source>
        <translation>C&amp;oller</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Supprimer</translation>
    </message>
    <message>
        <source>Select All</source>
        <translation>Tout sélectionner</translation>
    </message>
</context>
<context>
    <name>Shapes</name>
    <message>
        <source>Polygon</source>
        <translation>Polygone</translation>
    </message>
    <message>
        <source>Box</source>
        <translation>Boîte</translation>
    </message>
    <message>
        <source>Sphere</source>
        <translation>Sphère</translation>
    </message>
    <message>
        <source>Cylinder</source>
        <translation>Cylindre</translation>
    </message>
    <message>
        <source>Cone</source>
        <translation>Cône</translation>
    </message>
    <message>
        <source>Disc</source>
        <translation>Disque</translation>
    </message>
    <message>
        <source>Mesh</source>
        <translation>Maillage</translation>
    </message>
</context>
<context>
    <name>Tools</name>
    <message>
        <source>Add %1</source>
        <translation>Ajouter %1</translation>
    </message>
    <message>
        <source>%1 is being loaded...</source>
        <translation>Chargement de %1...</translation>
    </message>
    <message>
        <source>%1 on %2</source>
        <translation>%1 sur %2</translation>
    </message>
    <message>
        <source>%1 at x %2 m, y %3 m, z %4 m</source>
        <translation>%1 à x %2 m, y %3 m, z %4 m</translation>
    </message>
    <message>
        <source>Set material %1</source>
        <translation>Appliquer le matériau %1</translation>
    </message>
    <message>
        <source>The selection is locked: unlock it to change its place</source>
        <translation>La sélection est verrouillée&#xa0;: déverrouillez-la pour la déplacer</translation>
    </message>
    <message>
        <source>Cancelled</source>
        <translation>Annulé</translation>
    </message>
    <message>
        <source>   flush in %1</source>
        <translation>   affleurant en %1</translation>
    </message>
    <message>
        <source>Move</source>
        <translation>Déplacer</translation>
    </message>
    <message>
        <source>Rotate</source>
        <translation>Tourner</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>Redimensionner</translation>
    </message>
</context>
<context>
    <name>atrium::ui::AutomaticText</name>
    <message>
        <source>automatic</source>
        <translation>automatique</translation>
    </message>
    <message>
        <source>automatic (%1)</source>
        <translation>automatique (%1)</translation>
    </message>
    <message>
        <source>auto (%1)</source>
        <translation>auto (%1)</translation>
    </message>
</context>
<context>
    <name>atrium::ui::CameraSection</name>
    <message>
        <source>Camera</source>
        <translation>Caméra</translation>
    </message>
    <message>
        <source>Field of view</source>
        <translation>Champ de vision</translation>
    </message>
    <message>
        <source>View height</source>
        <translation>Hauteur de vue</translation>
    </message>
    <message>
        <source> EV</source>
        <translation> IL</translation>
    </message>
    <message>
        <source>Exposure</source>
        <translation>Exposition</translation>
    </message>
    <message>
        <source>Look Through</source>
        <translation>Regarder par elle</translation>
    </message>
    <message>
        <source>Show what this camera sees</source>
        <translation>Montrer ce que voit cette caméra</translation>
    </message>
</context>
<context>
    <name>atrium::ui::CausticPanel</name>
    <message>
        <source>Filter surfaces</source>
        <translation>Filtrer les surfaces</translation>
    </message>
    <message>
        <source>Filter surfaces by name, decision or reason</source>
        <translation>Filtrer les surfaces par nom, décision ou raison</translation>
    </message>
    <message>
        <source>Surfaces that caustics fall on</source>
        <translation>Surfaces qui reçoivent des caustiques</translation>
    </message>
    <message>
        <source>Restriction boxes</source>
        <translation>Cadres de restriction</translation>
    </message>
    <message>
        <source>u</source>
        <translation>u</translation>
    </message>
    <message>
        <source>v</source>
        <translation>v</translation>
    </message>
    <message>
        <source>Across</source>
        <translation>En largeur</translation>
    </message>
    <message>
        <source>Up</source>
        <translation>En hauteur</translation>
    </message>
    <message>
        <source>Texels</source>
        <translation>Texels</translation>
    </message>
    <message>
        <source>Choose a surface in the table.</source>
        <translation>Choisissez une surface dans le tableau.</translation>
    </message>
    <message>
        <source>Piece</source>
        <translation>Morceau</translation>
    </message>
    <message>
        <source>%1 x %2</source>
        <translation>%1 x %2</translation>
    </message>
    <message>
        <source>Particles</source>
        <translation>Particules</translation>
    </message>
    <message>
        <source>%1, contrast %2</source>
        <translation>%1, contraste %2</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>Kernels</source>
        <translation>Noyaux</translation>
    </message>
    <message>
        <source>Boxes</source>
        <translation>Cadres</translation>
    </message>
    <message>
        <source>%1, covering %2; %3</source>
        <translation>%1, couvrant %2&#xa0;; %3</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Lumière</translation>
    </message>
    <message>
        <source>%1 in textures, %2 on the mesh</source>
        <translation>%1 en textures, %2 sur le maillage</translation>
    </message>
    <message>
        <source>%1 to %2</source>
        <translation>%1 à %2</translation>
    </message>
    <message>
        <source>%1 m</source>
        <translation>%1 m</translation>
    </message>
</context>
<context>
    <name>atrium::ui::CausticPreview</name>
    <message>
        <source>Picture of the caustic textures</source>
        <translation>Image des textures de caustiques</translation>
    </message>
    <message>
        <source>Wheel: zoom. Drag: shift. Double click: all boxes, then the whole piece.</source>
        <translation>Molette&#xa0;: zoom. Glisser&#xa0;: décaler. Double clic&#xa0;: tous les cadres, puis le morceau entier.</translation>
    </message>
    <message>
        <source>Making the picture...</source>
        <translation>Préparation de l&apos;image...</translation>
    </message>
    <message>
        <source>No texture: all of it is on the mesh</source>
        <translation>Pas de texture&#xa0;: tout est sur le maillage</translation>
    </message>
    <message>
        <source>%1 m, %2 m: %3 lx in textures</source>
        <translation>%1 m, %2 m&#xa0;: %3 lx en textures</translation>
    </message>
    <message>
        <source>1 texel = %1 pixels</source>
        <translation>1 texel = %1 pixels</translation>
    </message>
    <message>
        <source>1 pixel = %1 texels</source>
        <translation>1 pixel = %1 texels</translation>
    </message>
</context>
<context>
    <name>atrium::ui::CausticSection</name>
    <message>
        <source>Set by hand</source>
        <translation>Réglé à la main</translation>
    </message>
    <message>
        <source>Show caustics</source>
        <translation>Montrer les caustiques</translation>
    </message>
    <message>
        <source>Automatically</source>
        <translation>Automatiquement</translation>
    </message>
    <message>
        <source>On the mesh only</source>
        <translation>Sur le maillage seulement</translation>
    </message>
    <message>
        <source>In textures</source>
        <translation>En textures</translation>
    </message>
    <message>
        <source>Texel size</source>
        <translation>Taille des texels</translation>
    </message>
    <message>
        <source>Threshold</source>
        <translation>Seuil</translation>
    </message>
    <message>
        <source>Standard deviations by which light must be more uneven than chance to get a texture</source>
        <translation>De combien d&apos;écarts types la lumière doit être plus inégale que le hasard pour avoir une texture</translation>
    </message>
    <message>
        <source>Reset to Automatic</source>
        <translation>Revenir à l&apos;automatique</translation>
    </message>
    <message>
        <source>Reset caustics to automatic</source>
        <translation>Remettre les caustiques en automatique</translation>
    </message>
</context>
<context>
    <name>atrium::ui::CausticTableModel</name>
    <message>
        <source>%1 x %2 texels over the whole piece</source>
        <translation>%1 x %2 texels sur tout le morceau</translation>
    </message>
    <message>
        <source>Surface</source>
        <translation>Surface</translation>
    </message>
    <message>
        <source>Name of the object, with part, piece and side where there are several</source>
        <translation>Nom de l&apos;objet, avec partie, morceau et côté s&apos;il y en a plusieurs</translation>
    </message>
    <message>
        <source>Shown as</source>
        <translation>Affiché en</translation>
    </message>
    <message>
        <source>Where the caustic light is kept: in textures or on the corners of the mesh</source>
        <translation>Où la lumière des caustiques est gardée&#xa0;: dans des textures ou aux sommets du maillage</translation>
    </message>
    <message>
        <source>Why</source>
        <translation>Pourquoi</translation>
    </message>
    <message>
        <source>What the tests found</source>
        <translation>Ce que les tests ont trouvé</translation>
    </message>
    <message>
        <source>Particles</source>
        <translation>Particules</translation>
    </message>
    <message>
        <source>Particles that landed here</source>
        <translation>Particules qui ont atterri ici</translation>
    </message>
    <message>
        <source>Texel</source>
        <translation>Texel</translation>
    </message>
    <message>
        <source>Edge of a texel on the surface</source>
        <translation>Côté d&apos;un texel sur la surface</translation>
    </message>
    <message>
        <source>Texel follows</source>
        <translation>Le texel suit</translation>
    </message>
    <message>
        <source>What decides the size of the texels</source>
        <translation>Ce qui décide de la taille des texels</translation>
    </message>
    <message>
        <source>Kernel</source>
        <translation>Noyau</translation>
    </message>
    <message>
        <source>Width of the spot that a particle&apos;s light is spread over, across its narrow side; the median</source>
        <translation>Largeur de la tache sur laquelle la lumière d&apos;une particule est étalée, dans son côté étroit&#xa0;; la médiane</translation>
    </message>
    <message>
        <source>Boxes</source>
        <translation>Cadres</translation>
    </message>
    <message>
        <source>Restriction boxes: the textures cover no more than these</source>
        <translation>Cadres de restriction&#xa0;: les textures ne couvrent pas plus</translation>
    </message>
    <message>
        <source>Covered</source>
        <translation>Couvert</translation>
    </message>
    <message>
        <source>Share of the piece that the boxes cover</source>
        <translation>Part du morceau que couvrent les cadres</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>Mémoire</translation>
    </message>
    <message>
        <source>Of the textures</source>
        <translation>Des textures</translation>
    </message>
    <message>
        <source>In textures</source>
        <translation>En textures</translation>
    </message>
    <message>
        <source>Light in the textures</source>
        <translation>Lumière dans les textures</translation>
    </message>
    <message>
        <source>On mesh</source>
        <translation>Sur maillage</translation>
    </message>
    <message>
        <source>Light on the corners of the mesh</source>
        <translation>Lumière aux sommets du maillage</translation>
    </message>
</context>
<context>
    <name>atrium::ui::ColorButton</name>
    <message>
        <source>Choose a colour</source>
        <translation>Choisir une couleur</translation>
    </message>
    <message>
        <source>mixed</source>
        <translation>mixte</translation>
    </message>
</context>
<context>
    <name>atrium::ui::ConvergencePanel</name>
    <message>
        <source>What the plot shows</source>
        <translation>Ce que montre le tracé</translation>
    </message>
    <message>
        <source>Last solution</source>
        <translation>Dernière solution</translation>
    </message>
    <message>
        <source>Whole session</source>
        <translation>Toute la session</translation>
    </message>
    <message>
        <source>The way to the present light, or all solutions and updates since the scene was opened</source>
        <translation>Le chemin vers la lumière actuelle, ou toutes les solutions et mises à jour depuis l&apos;ouverture de la scène</translation>
    </message>
    <message>
        <source>&amp;Save Plot...</source>
        <translation>Enregistrer le &amp;tracé...</translation>
    </message>
    <message>
        <source>Save the plot as PNG or SVG, or its figures as CSV</source>
        <translation>Enregistrer le tracé en PNG ou SVG, ou ses chiffres en CSV</translation>
    </message>
    <message>
        <source>Figures of the light, by the names of --stats</source>
        <translation>Chiffres de la lumière, sous les noms de --stats</translation>
    </message>
    <message>
        <source>%1 for %2, %3 %</source>
        <translation>%1 pour %2, %3&#xa0;%</translation>
    </message>
    <message>
        <source>No light yet</source>
        <translation>Pas encore de lumière</translation>
    </message>
    <message>
        <source>Save Plot</source>
        <translation>Enregistrer le tracé</translation>
    </message>
    <message>
        <source>PNG picture (*.png);;SVG drawing (*.svg);;CSV table (*.csv)</source>
        <translation>Image PNG (*.png);;Dessin SVG (*.svg);;Tableau CSV (*.csv)</translation>
    </message>
    <message>
        <source>convergence.png</source>
        <translation>convergence.png</translation>
    </message>
    <message>
        <source>Written to %1.</source>
        <translation>Écrit dans %1.</translation>
    </message>
</context>
<context>
    <name>atrium::ui::ConvergencePlot</name>
    <message>
        <source>estimate</source>
        <translation>estimation</translation>
    </message>
    <message>
        <source>Error against run time</source>
        <translation>Erreur en fonction du temps de calcul</translation>
    </message>
    <message>
        <source>run time, s</source>
        <translation>temps de calcul, s</translation>
    </message>
    <message>
        <source>error, %</source>
        <translation>erreur,&#xa0;%</translation>
    </message>
    <message>
        <source>updates</source>
        <translation>mises à jour</translation>
    </message>
    <message>
        <source>measured</source>
        <translation>mesurée</translation>
    </message>
</context>
<context>
    <name>atrium::ui::DaylightBar</name>
    <message>
        <source>Nothing in this scene gives light. Until something does, it is shown in a neutral working light.</source>
        <translation>Rien dans cette scène n&apos;éclaire. En attendant, elle est montrée sous une lumière de travail neutre.</translation>
    </message>
    <message>
        <source>Add &amp;Daylight</source>
        <translation>Ajouter la lumière du &amp;jour</translation>
    </message>
    <message>
        <source>Add a sun and a uniform sky; one step to undo</source>
        <translation>Ajouter un soleil et un ciel uniforme&#xa0;; une étape à annuler</translation>
    </message>
    <message>
        <source>&amp;Not Now</source>
        <translation>&amp;Pas maintenant</translation>
    </message>
</context>
<context>
    <name>atrium::ui::EditController</name>
    <message numerus="yes">
        <source>%n object(s) copied.</source>
        <translation>
            <numerusform>%n objet copié.</numerusform>
            <numerusform>%n objets copiés.</numerusform>
        </translation>
    </message>
    <message>
        <source>The selection is locked: unlock it to cut it.</source>
        <translation>La sélection est verrouillée&#xa0;: déverrouillez-la pour la couper.</translation>
    </message>
    <message>
        <source>Cut</source>
        <translation>Couper</translation>
    </message>
    <message>
        <source>No material was copied.</source>
        <translation>Aucun matériau n&apos;a été copié.</translation>
    </message>
    <message>
        <source>No objects were copied.</source>
        <translation>Aucun objet n&apos;a été copié.</translation>
    </message>
    <message>
        <source>Paste</source>
        <translation>Coller</translation>
    </message>
    <message>
        <source>%1 copied.</source>
        <translation>%1 copié.</translation>
    </message>
    <message>
        <source>The active object has no material of its own.</source>
        <translation>L&apos;objet actif n&apos;a pas de matériau propre.</translation>
    </message>
    <message>
        <source>Paste material</source>
        <translation>Coller le matériau</translation>
    </message>
    <message>
        <source>The selection has no surface.</source>
        <translation>La sélection n&apos;a pas de surface.</translation>
    </message>
    <message>
        <source>Set material %1</source>
        <translation>Appliquer le matériau %1</translation>
    </message>
    <message numerus="yes">
        <source>%1 given to %n object(s).</source>
        <translation>
            <numerusform>%1 appliqué à %n objet.</numerusform>
            <numerusform>%1 appliqué à %n objets.</numerusform>
        </translation>
    </message>
    <message>
        <source>Lock</source>
        <translation>Verrouiller</translation>
    </message>
    <message>
        <source>Unlock</source>
        <translation>Déverrouiller</translation>
    </message>
    <message>
        <source>Polygon</source>
        <translation>Polygone</translation>
    </message>
    <message>
        <source>Box</source>
        <translation>Boîte</translation>
    </message>
    <message>
        <source>Sphere</source>
        <translation>Sphère</translation>
    </message>
    <message>
        <source>Cylinder</source>
        <translation>Cylindre</translation>
    </message>
    <message>
        <source>Cone</source>
        <translation>Cône</translation>
    </message>
    <message>
        <source>Disc</source>
        <translation>Disque</translation>
    </message>
    <message>
        <source>Point light</source>
        <translation>Lumière ponctuelle</translation>
    </message>
    <message>
        <source>Spot light</source>
        <translation>Projecteur</translation>
    </message>
    <message>
        <source>Sun</source>
        <translation>Soleil</translation>
    </message>
    <message>
        <source>Area light</source>
        <translation>Lumière surfacique</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Caméra</translation>
    </message>
    <message>
        <source>Select an object first.</source>
        <translation>Sélectionnez d&apos;abord un objet.</translation>
    </message>
    <message>
        <source>Duplicate</source>
        <translation>Dupliquer</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Supprimer</translation>
    </message>
    <message numerus="yes">
        <source>%n locked object(s) kept. Unlock them in the scene tree first.</source>
        <translation>
            <numerusform>%n objet verrouillé gardé. Déverrouillez-le d&apos;abord dans l&apos;arbre de la scène.</numerusform>
            <numerusform>%n objets verrouillés gardés. Déverrouillez-les d&apos;abord dans l&apos;arbre de la scène.</numerusform>
        </translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>Masquer</translation>
    </message>
    <message>
        <source>Show all</source>
        <translation>Tout afficher</translation>
    </message>
    <message>
        <source>Group</source>
        <translation>Grouper</translation>
    </message>
    <message>
        <source>Add %1</source>
        <translation>Ajouter %1</translation>
    </message>
    <message>
        <source>Import correction</source>
        <translation>Correction d&apos;import</translation>
    </message>
    <message>
        <source>Correct units and direction</source>
        <translation>Corriger unités et direction</translation>
    </message>
    <message>
        <source>Add daylight</source>
        <translation>Ajouter la lumière du jour</translation>
    </message>
</context>
<context>
    <name>atrium::ui::ExportPictureDialog</name>
    <message>
        <source>Export Picture</source>
        <translation>Exporter une image</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>Largeur</translation>
    </message>
    <message>
        <source> px</source>
        <translation> px</translation>
    </message>
    <message>
        <source>Height</source>
        <translation>Hauteur</translation>
    </message>
    <message>
        <source>Samples per pixel side</source>
        <translation>Échantillons par côté de pixel</translation>
    </message>
    <message>
        <source>PNG is shown as in the view; EXR holds linear values in cd/m².</source>
        <translation>Le PNG est comme dans la vue&#xa0;; l&apos;EXR contient des valeurs linéaires en cd/m².</translation>
    </message>
    <message>
        <source>PNG is in false colour as in the view, with its legend; EXR holds linear values in cd/m².</source>
        <translation>Le PNG est en fausses couleurs comme dans la vue, avec sa légende&#xa0;; l&apos;EXR contient des valeurs linéaires en cd/m².</translation>
    </message>
    <message>
        <source>Light as in the view: only %1.</source>
        <translation>Lumière comme dans la vue&#xa0;: seulement %1.</translation>
    </message>
    <message>
        <source>Render...</source>
        <translation>Calculer...</translation>
    </message>
    <message>
        <source>PNG picture (*.png);;OpenEXR (*.exr)</source>
        <translation>Image PNG (*.png);;OpenEXR (*.exr)</translation>
    </message>
    <message>
        <source>Picture written to %1.</source>
        <translation>Image écrite dans %1.</translation>
    </message>
    <message>
        <source>Final pass: compute the light of every pixel</source>
        <translation>Passe finale : calculer la lumière de chaque pixel</translation>
    </message>
    <message>
        <source>Contacts, folds and small things become as sharp as the picture. Takes minutes.</source>
        <translation>Les contacts, les plis et les petits objets deviennent aussi nets que l&apos;image. Prend des minutes.</translation>
    </message>
    <message>
        <source>Samples per pixel</source>
        <translation>Échantillons par pixel</translation>
    </message>
    <message>
        <source>Rounded up to a power of two. Four times as many halve the grain.</source>
        <translation>Arrondi à la puissance de deux supérieure. Quatre fois plus divisent le grain par deux.</translation>
    </message>
    <message>
        <source>Also write parts of the light, depth, normals and colours (EXR)</source>
        <translation>Écrire aussi les parts de la lumière, la profondeur, les normales et les couleurs (EXR)</translation>
    </message>
    <message>
        <source>Preview</source>
        <translation>Aperçu</translation>
    </message>
</context>
<context>
    <name>atrium::ui::FalseColorBar</name>
    <message>
        <source>Kind of scale</source>
        <translation>Type d&apos;échelle</translation>
    </message>
    <message>
        <source>Linear</source>
        <translation>Linéaire</translation>
    </message>
    <message>
        <source>Logarithmic</source>
        <translation>Logarithmique</translation>
    </message>
    <message>
        <source>Even steps of light, or even factors: for rooms with sun and shade</source>
        <translation>Pas égaux de lumière, ou facteurs égaux&#xa0;: pour des pièces avec soleil et ombre</translation>
    </message>
    <message>
        <source>Automatic range</source>
        <translation>Plage automatique</translation>
    </message>
    <message>
        <source>Fit the range to the light of the scene; it stays while you move things</source>
        <translation>Ajuster la plage à la lumière de la scène&#xa0;; elle reste pendant que vous déplacez des objets</translation>
    </message>
    <message>
        <source>Lower end of the range</source>
        <translation>Bas de la plage</translation>
    </message>
    <message>
        <source>Upper end of the range</source>
        <translation>Haut de la plage</translation>
    </message>
    <message>
        <source>from</source>
        <translation>de</translation>
    </message>
    <message>
        <source>to</source>
        <translation>à</translation>
    </message>
</context>
<context>
    <name>atrium::ui::FileController</name>
    <message>
        <source>Scenes (*.atrium *.gltf *.glb);;Atrium projects (*.atrium);;glTF (*.gltf *.glb);;All files (*)</source>
        <translation>Scènes (*.atrium *.gltf *.glb);;Projets Atrium (*.atrium);;glTF (*.gltf *.glb);;Tous les fichiers (*)</translation>
    </message>
    <message>
        <source>File: %1</source>
        <translation>Fichier&#xa0;: %1</translation>
    </message>
    <message>
        <source>Place: %1</source>
        <translation>Endroit&#xa0;: %1</translation>
    </message>
    <message>
        <source>Untitled</source>
        <translation>Sans titre</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Ouvrir</translation>
    </message>
    <message>
        <source>Open elsewhere</source>
        <translation>Ouvert ailleurs</translation>
    </message>
    <message>
        <source>%1 is open in another Atrium.</source>
        <translation>%1 est ouvert dans un autre Atrium.</translation>
    </message>
    <message>
        <source>It is held by %1. If both save, the one that saves last is asked what to do.</source>
        <translation>Il est tenu par %1. Si les deux enregistrent, le dernier se verra demander que faire.</translation>
    </message>
    <message>
        <source>Open Read-Only</source>
        <translation>Ouvrir en lecture seule</translation>
    </message>
    <message>
        <source>Open Anyway</source>
        <translation>Ouvrir quand même</translation>
    </message>
    <message>
        <source>Opening %1</source>
        <translation>Ouverture de %1</translation>
    </message>
    <message>
        <source>%1 could not be opened</source>
        <translation>%1 n&apos;a pas pu être ouvert</translation>
    </message>
    <message>
        <source>Damaged file</source>
        <translation>Fichier endommagé</translation>
    </message>
    <message>
        <source>%1 is damaged.</source>
        <translation>%1 est endommagé.</translation>
    </message>
    <message numerus="yes">
        <source>%n object(s) can be saved from it. The file itself is left as it is.</source>
        <translation>
            <numerusform>%n objet peut en être sauvé. Le fichier lui-même reste tel quel.</numerusform>
            <numerusform>%n objets peuvent en être sauvés. Le fichier lui-même reste tel quel.</numerusform>
        </translation>
    </message>
    <message>
        <source>Open What Is Left</source>
        <translation>Ouvrir ce qui reste</translation>
    </message>
    <message>
        <source>Opening was cancelled.</source>
        <translation>L&apos;ouverture a été annulée.</translation>
    </message>
    <message>
        <source>Import</source>
        <translation>Importer</translation>
    </message>
    <message>
        <source>Importing %1</source>
        <translation>Import de %1</translation>
    </message>
    <message>
        <source>%1 could not be imported</source>
        <translation>%1 n&apos;a pas pu être importé</translation>
    </message>
    <message>
        <source>Import %1</source>
        <translation>Importer %1</translation>
    </message>
    <message>
        <source>Imported %1 objects.</source>
        <translation>%1 objets importés.</translation>
    </message>
    <message>
        <source>No image of this scene is missing.</source>
        <translation>Aucune image ne manque à cette scène.</translation>
    </message>
    <message>
        <source>Folder with the Images</source>
        <translation>Dossier des images</translation>
    </message>
    <message>
        <source>Looking for images</source>
        <translation>Recherche des images</translation>
    </message>
    <message>
        <source>The images could not be looked for</source>
        <translation>Les images n&apos;ont pas pu être cherchées</translation>
    </message>
    <message>
        <source>Find Missing Images</source>
        <translation>Chercher les images manquantes</translation>
    </message>
    <message>
        <source>The images could not be used</source>
        <translation>Les images n&apos;ont pas pu être utilisées</translation>
    </message>
    <message numerus="yes">
        <source>%n image(s) found; none is missing.</source>
        <translation>
            <numerusform>%n image trouvée&#xa0;; il n&apos;en manque aucune.</numerusform>
            <numerusform>%n images trouvées&#xa0;; il n&apos;en manque aucune.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n image(s) found.</source>
        <translation>
            <numerusform>%n image trouvée.</numerusform>
            <numerusform>%n images trouvées.</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n image(s) still missing.</source>
        <translation>
            <numerusform>Il manque encore %n image.</numerusform>
            <numerusform>Il manque encore %n images.</numerusform>
        </translation>
    </message>
    <message>
        <source>There is no recovered work.</source>
        <translation>Il n&apos;y a pas de travail récupéré.</translation>
    </message>
    <message>
        <source>There is no saved file to go back to.</source>
        <translation>Il n&apos;y a pas de fichier enregistré auquel revenir.</translation>
    </message>
    <message>
        <source>Revert</source>
        <translation>Revenir</translation>
    </message>
    <message>
        <source>Go back to %1 as it was saved?</source>
        <translation>Revenir à %1 tel qu&apos;il a été enregistré&#xa0;?</translation>
    </message>
    <message>
        <source>It was saved on %1. What was changed since can be had back for two weeks: File &gt; Recovered Work.</source>
        <translation>Il a été enregistré le %1. Ce qui a changé depuis peut être repris pendant deux semaines&#xa0;: Fichier &gt; Travail récupéré.</translation>
    </message>
    <message>
        <source>what would be lost could not be put aside first</source>
        <translation>ce qui serait perdu n&apos;a pas pu être mis de côté d&apos;abord</translation>
    </message>
    <message>
        <source>Save the scene under another name, then open the file again.</source>
        <translation>Enregistrez la scène sous un autre nom, puis rouvrez le fichier.</translation>
    </message>
    <message>
        <source>Nothing was reverted</source>
        <translation>Rien n&apos;a été abandonné</translation>
    </message>
    <message>
        <source>%1 copy</source>
        <comment>suggested file name</comment>
        <translation>%1 copie</translation>
    </message>
    <message>
        <source>Save Project</source>
        <translation>Enregistrer le projet</translation>
    </message>
    <message>
        <source>Atrium projects (*.atrium)</source>
        <translation>Projets Atrium (*.atrium)</translation>
    </message>
    <message>
        <source>Export glTF</source>
        <translation>Exporter en glTF</translation>
    </message>
    <message>
        <source>glTF binary (*.glb);;glTF (*.gltf)</source>
        <translation>glTF binaire (*.glb);;glTF (*.gltf)</translation>
    </message>
    <message>
        <source>Changed by another program</source>
        <translation>Modifié par un autre programme</translation>
    </message>
    <message>
        <source>%1 has been changed since it was opened here.</source>
        <translation>%1 a été modifié depuis son ouverture ici.</translation>
    </message>
    <message>
        <source>It was written on %1. Overwriting it loses what was changed there.</source>
        <translation>Il a été écrit le %1. L&apos;écraser perdrait ce qui y a changé.</translation>
    </message>
    <message>
        <source>Save Under Another Name...</source>
        <translation>Enregistrer sous un autre nom...</translation>
    </message>
    <message>
        <source>Overwrite</source>
        <translation>Écraser</translation>
    </message>
    <message>
        <source>%1 could not be saved</source>
        <translation>%1 n&apos;a pas pu être enregistré</translation>
    </message>
    <message>
        <source>Your changes are still here.</source>
        <translation>Vos modifications sont toujours là.</translation>
    </message>
    <message>
        <source>Try Again</source>
        <translation>Réessayer</translation>
    </message>
    <message>
        <source>Still saving; try again in a moment.</source>
        <translation>Enregistrement en cours&#xa0;; réessayez dans un instant.</translation>
    </message>
    <message>
        <source>it is open in another Atrium (%1)</source>
        <translation>il est ouvert dans un autre Atrium (%1)</translation>
    </message>
    <message>
        <source>Saving %1</source>
        <translation>Enregistrement de %1</translation>
    </message>
    <message>
        <source>%1 was gone and has been written again.</source>
        <translation>%1 avait disparu et a été réécrit.</translation>
    </message>
    <message>
        <source>Saved %1.</source>
        <translation>%1 enregistré.</translation>
    </message>
    <message>
        <source>Exported %1.</source>
        <translation>%1 exporté.</translation>
    </message>
    <message>
        <source>Unsaved changes</source>
        <translation>Modifications non enregistrées</translation>
    </message>
    <message>
        <source>Save the changes to %1?</source>
        <translation>Enregistrer les modifications de %1&#xa0;?</translation>
    </message>
    <message>
        <source>What is discarded can be had back for two weeks: File &gt; Recovered Work.</source>
        <translation>Ce qui n&apos;est pas enregistré peut être repris pendant deux semaines&#xa0;: Fichier &gt; Travail récupéré.</translation>
    </message>
    <message>
        <source>the stored light could not be used: %1</source>
        <translation>la lumière enregistrée n&apos;a pas pu être utilisée : %1</translation>
    </message>
</context>
<context>
    <name>atrium::ui::ImportBar</name>
    <message>
        <source>units of %1 m</source>
        <translation>unités de %1 m</translation>
    </message>
    <message>
        <source>&amp;Fix</source>
        <translation>&amp;Corriger</translation>
    </message>
    <message>
        <source>Put everything into a group that corrects this; one step to undo</source>
        <translation>Tout mettre dans un groupe qui corrige cela&#xa0;; une étape à annuler</translation>
    </message>
    <message>
        <source>&amp;Keep</source>
        <translation>&amp;Garder</translation>
    </message>
    <message>
        <source>Leave the file as it is</source>
        <translation>Laisser le fichier tel quel</translation>
    </message>
    <message>
        <source>This file looks like %1, with +Z up.</source>
        <translation>Ce fichier semble être en %1, avec +Z vers le haut.</translation>
    </message>
    <message>
        <source>This file looks like +Z is up in it.</source>
        <translation>Dans ce fichier, +Z semble être vers le haut.</translation>
    </message>
    <message>
        <source>This file looks like %1.</source>
        <translation>Ce fichier semble être en %1.</translation>
    </message>
    <message>
        <source>millimetres</source>
        <translation>millimètres</translation>
    </message>
    <message>
        <source>centimetres</source>
        <translation>centimètres</translation>
    </message>
    <message>
        <source>inches</source>
        <translation>pouces</translation>
    </message>
    <message>
        <source>feet</source>
        <translation>pieds</translation>
    </message>
</context>
<context>
    <name>atrium::ui::JobsPanel</name>
    <message>
        <source>Solving %1 %</source>
        <translation>Calcul %1&#xa0;%</translation>
    </message>
    <message>
        <source>Light follows</source>
        <translation>La lumière suit</translation>
    </message>
    <message>
        <source>Settling %1 %</source>
        <translation>Stabilisation %1&#xa0;%</translation>
    </message>
    <message>
        <source>Settled, refining %1 %</source>
        <translation>Stabilisé, affinage %1&#xa0;%</translation>
    </message>
    <message>
        <source>Light up to date</source>
        <translation>Lumière à jour</translation>
    </message>
    <message>
        <source>Light out of date</source>
        <translation>Lumière périmée</translation>
    </message>
    <message>
        <source>Light stopped</source>
        <translation>Lumière arrêtée</translation>
    </message>
    <message>
        <source>Light failed</source>
        <translation>Échec de la lumière</translation>
    </message>
    <message>
        <source>No light yet</source>
        <translation>Pas encore de lumière</translation>
    </message>
    <message>
        <source>Progress of the light</source>
        <translation>Avancement de la lumière</translation>
    </message>
    <message>
        <source>Figures of the solution</source>
        <translation>Chiffres de la solution</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Arrêter</translation>
    </message>
    <message>
        <source>Resume</source>
        <translation>Reprendre</translation>
    </message>
    <message>
        <source> (the picture is older)</source>
        <translation> (l&apos;image est plus ancienne)</translation>
    </message>
    <message>
        <source>, about %1 left</source>
        <translation>, encore %1 environ</translation>
    </message>
    <message>
        <source>No solution yet</source>
        <translation>Pas encore de solution</translation>
    </message>
    <message>
        <source>Error</source>
        <translation>Erreur</translation>
    </message>
    <message>
        <source>%1 (%2 to %3)</source>
        <translation>%1 (%2 à %3)</translation>
    </message>
    <message>
        <source>Root mean square over all surfaces, measured at %L1 places against brute force; it lies between the bounds 95 times in 100.</source>
        <translation>Moyenne quadratique sur toutes les surfaces, mesurée en %L1 endroits contre la force brute&#xa0;; elle est entre les bornes 95 fois sur 100.</translation>
    </message>
    <message>
        <source>Error of the mean</source>
        <translation>Erreur de la moyenne</translation>
    </message>
    <message>
        <source>%1%2</source>
        <translation>%1%2</translation>
    </message>
    <message>
        <source>−</source>
        <translation>−</translation>
    </message>
    <message>
        <source>+</source>
        <translation>+</translation>
    </message>
    <message>
        <source>not measured yet</source>
        <translation>pas encore mesurée</translation>
    </message>
    <message>
        <source>Solved in</source>
        <translation>Calculé en</translation>
    </message>
    <message>
        <source>Iterations</source>
        <translation>Itérations</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>converged</source>
        <translation>convergé</translation>
    </message>
    <message>
        <source>not converged</source>
        <translation>non convergé</translation>
    </message>
    <message>
        <source>Elements</source>
        <translation>Éléments</translation>
    </message>
    <message>
        <source>Links</source>
        <translation>Liens</translation>
    </message>
    <message>
        <source>Rays</source>
        <translation>Rayons</translation>
    </message>
    <message>
        <source>Light emitted</source>
        <translation>Lumière émise</translation>
    </message>
    <message>
        <source>%1 lm</source>
        <translation>%1 lm</translation>
    </message>
    <message>
        <source>Memory</source>
        <translation>Mémoire</translation>
    </message>
    <message>
        <source>Phases</source>
        <translation>Phases</translation>
    </message>
    <message>
        <source>Left out</source>
        <translation>Laissé de côté</translation>
    </message>
    <message>
        <source>In use</source>
        <translation>Utilisé</translation>
    </message>
    <message>
        <source>Preparing rays</source>
        <translation>Préparation des rayons</translation>
    </message>
    <message>
        <source>Unrolling surfaces</source>
        <translation>Dépliage des surfaces</translation>
    </message>
    <message>
        <source>Finding shadows</source>
        <translation>Recherche des ombres</translation>
    </message>
    <message>
        <source>Looking closer</source>
        <translation>Examen plus fin</translation>
    </message>
    <message>
        <source>Dividing surfaces</source>
        <translation>Division des surfaces</translation>
    </message>
    <message>
        <source>Finding what sees what</source>
        <translation>Recherche de ce qui se voit</translation>
    </message>
    <message>
        <source>Tracing visibility</source>
        <translation>Tracé de la visibilité</translation>
    </message>
    <message>
        <source>Gathering light</source>
        <translation>Collecte de la lumière</translation>
    </message>
    <message>
        <source>Painting light onto surfaces</source>
        <translation>Report de la lumière sur les surfaces</translation>
    </message>
    <message>
        <source>Measuring the error</source>
        <translation>Mesure de l&apos;erreur</translation>
    </message>
    <message>
        <source>Getting ready to follow edits: %1</source>
        <translation>Se prépare à suivre les modifications : %1</translation>
    </message>
    <message>
        <source>The light is coarser than its quality asks for, to stay within the memory that it may take. Left out: %1.
Edit &gt; Preferences gives it more.</source>
        <translation>La lumière est plus grossière que sa qualité ne le demande, pour rester dans la mémoire qu&apos;elle peut prendre. Laissé de côté : %1.
Édition &gt; Préférences lui en donne plus.</translation>
    </message>
    <message>
        <source>, </source>
        <comment>between items of a list</comment>
        <translation>, </translation>
    </message>
</context>
<context>
    <name>atrium::ui::LibraryModel</name>
    <message>
        <source>There are no glTF files in %1.</source>
        <translation>Il n&apos;y a pas de fichier glTF dans %1.</translation>
    </message>
</context>
<context>
    <name>atrium::ui::LibraryPanel</name>
    <message>
        <source>Search the library</source>
        <translation>Chercher dans la bibliothèque</translation>
    </message>
    <message>
        <source>Search the library by name</source>
        <translation>Chercher par nom dans la bibliothèque</translation>
    </message>
    <message>
        <source>Sections of the library</source>
        <translation>Rubriques de la bibliothèque</translation>
    </message>
    <message>
        <source>Shapes</source>
        <translation>Formes</translation>
    </message>
    <message>
        <source>Materials</source>
        <translation>Matériaux</translation>
    </message>
    <message>
        <source>Lamps</source>
        <translation>Lampes</translation>
    </message>
    <message>
        <source>Furniture</source>
        <translation>Meubles</translation>
    </message>
    <message>
        <source>Library</source>
        <translation>Bibliothèque</translation>
    </message>
    <message>
        <source>Choose &amp;Folder...</source>
        <translation>Choisir un &amp;dossier...</translation>
    </message>
    <message>
        <source>Choose the folder with your glTF models</source>
        <translation>Choisir le dossier de vos modèles glTF</translation>
    </message>
    <message>
        <source>Nothing in the library has this name.</source>
        <translation>Rien dans la bibliothèque ne porte ce nom.</translation>
    </message>
    <message>
        <source>Choose a folder with glTF models (.glb, .gltf): they appear here, ready to be dragged into the room.</source>
        <translation>Choisissez un dossier de modèles glTF (.glb, .gltf)&#xa0;: ils apparaissent ici, prêts à être glissés dans la pièce.</translation>
    </message>
    <message>
        <source>%1 is being loaded...</source>
        <translation>Chargement de %1...</translation>
    </message>
</context>
<context>
    <name>atrium::ui::LightBadge</name>
    <message>
        <source>, typical error %1</source>
        <translation>, erreur typique %1</translation>
    </message>
</context>
<context>
    <name>atrium::ui::LightSection</name>
    <message>
        <source>Lamp</source>
        <translation>Lampe</translation>
    </message>
    <message>
        <source>Switched on</source>
        <translation>Allumée</translation>
    </message>
    <message>
        <source>Kind</source>
        <translation>Type</translation>
    </message>
    <message>
        <source>Point</source>
        <translation>Ponctuelle</translation>
    </message>
    <message>
        <source>Spot</source>
        <translation>Projecteur</translation>
    </message>
    <message>
        <source>Sun</source>
        <translation>Soleil</translation>
    </message>
    <message>
        <source>Colour</source>
        <translation>Couleur</translation>
    </message>
    <message>
        <source>Intensity</source>
        <translation>Intensité</translation>
    </message>
    <message>
        <source>Flux</source>
        <translation>Flux</translation>
    </message>
    <message>
        <source>Dimming</source>
        <translation>Gradation</translation>
    </message>
    <message>
        <source>Remove photometry</source>
        <translation>Retirer la photométrie</translation>
    </message>
    <message>
        <source>Photometry</source>
        <translation>Photométrie</translation>
    </message>
    <message>
        <source>Beam angle</source>
        <translation>Angle du faisceau</translation>
    </message>
    <message>
        <source>Outer angle</source>
        <translation>Angle extérieur</translation>
    </message>
    <message>
        <source>Angular diameter</source>
        <translation>Diamètre angulaire</translation>
    </message>
    <message>
        <source> lx</source>
        <translation> lx</translation>
    </message>
    <message>
        <source> cd</source>
        <translation> cd</translation>
    </message>
</context>
<context>
    <name>atrium::ui::MainWindow</name>
    <message>
        <source>Untitled</source>
        <translation>Sans titre</translation>
    </message>
    <message>
        <source>%1[*] (read-only) - Atrium</source>
        <translation>%1[*] (lecture seule) - Atrium</translation>
    </message>
    <message>
        <source>%1[*] - Atrium</source>
        <translation>%1[*] - Atrium</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1&#xa0;: %2</translation>
    </message>
    <message>
        <source>&amp;Undo</source>
        <translation>&amp;Annuler</translation>
    </message>
    <message>
        <source>&amp;Redo</source>
        <translation>&amp;Rétablir</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>Scène</translation>
    </message>
    <message>
        <source>Properties</source>
        <translation>Propriétés</translation>
    </message>
    <message>
        <source>Problems</source>
        <translation>Problèmes</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Lumière</translation>
    </message>
    <message>
        <source>Caustics</source>
        <translation>Caustiques</translation>
    </message>
    <message>
        <source>Convergence</source>
        <translation>Convergence</translation>
    </message>
    <message>
        <source>Problems (%1)</source>
        <translation>Problèmes (%1)</translation>
    </message>
    <message>
        <source>%1 cm</source>
        <translation>%1 cm</translation>
    </message>
    <message>
        <source>%1 m</source>
        <translation>%1 m</translation>
    </message>
    <message>
        <source>Library</source>
        <translation>Bibliothèque</translation>
    </message>
    <message>
        <source>Folder with Furniture</source>
        <translation>Dossier de meubles</translation>
    </message>
    <message>
        <source>Snap %1, %2</source>
        <translation>Pas %1, %2</translation>
    </message>
    <message>
        <source>Slide and turn</source>
        <translation>Glisser et tourner</translation>
    </message>
    <message>
        <source>Slide</source>
        <translation>Glisser</translation>
    </message>
    <message>
        <source>How drags snap: Edit &gt; Snapping. Click to change it.</source>
        <translation>Comment les gestes s&apos;alignent&#xa0;: Édition &gt; Magnétisme. Cliquer pour le changer.</translation>
    </message>
    <message>
        <source>Snapping</source>
        <translation>Magnétisme</translation>
    </message>
    <message>
        <source>Grid step</source>
        <translation>Pas de la grille</translation>
    </message>
    <message>
        <source>Angle step</source>
        <translation>Pas des angles</translation>
    </message>
    <message>
        <source>View of %1</source>
        <translation>Vue de %1</translation>
    </message>
    <message>
        <source>The scene has no camera. Add one from the present view: Add &gt; Camera.</source>
        <translation>La scène n&apos;a pas de caméra. Ajoutez-en une depuis la vue actuelle&#xa0;: Ajout &gt; Caméra.</translation>
    </message>
    <message>
        <source>Save &amp;As...</source>
        <translation>Enregistrer &amp;sous...</translation>
    </message>
    <message>
        <source>Try A&amp;gain</source>
        <translation>&amp;Réessayer</translation>
    </message>
    <message>
        <source>Autosave failed; what is unsaved is in this window only. %1</source>
        <translation>La sauvegarde automatique a échoué&#xa0;; ce qui n&apos;est pas enregistré n&apos;est que dans cette fenêtre. %1</translation>
    </message>
    <message>
        <source>&amp;Find...</source>
        <translation>&amp;Chercher...</translation>
    </message>
    <message numerus="yes">
        <source>%n image(s) of this scene were not found; surfaces that use them show their plain colour.</source>
        <translation>
            <numerusform>%n image de cette scène n&apos;a pas été trouvée&#xa0;; les surfaces qui l&apos;utilisent montrent leur couleur unie.</numerusform>
            <numerusform>%n images de cette scène n&apos;ont pas été trouvées&#xa0;; les surfaces qui les utilisent montrent leur couleur unie.</numerusform>
        </translation>
    </message>
    <message>
        <source>There is no light to render yet.</source>
        <translation>Il n&apos;y a pas encore de lumière à calculer.</translation>
    </message>
    <message>
        <source>Drop the file onto a lamp in the view, or where a new lamp is to hang.</source>
        <translation>Déposez le fichier sur une lampe dans la vue, ou là où une nouvelle lampe doit être suspendue.</translation>
    </message>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Fichier</translation>
    </message>
    <message>
        <source>Open &amp;Recent</source>
        <translation>Fichiers &amp;récents</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>É&amp;dition</translation>
    </message>
    <message>
        <source>Sna&amp;pping</source>
        <translation>Ma&amp;gnétisme</translation>
    </message>
    <message>
        <source>&amp;Add</source>
        <translation>&amp;Ajout</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>Affic&amp;hage</translation>
    </message>
    <message>
        <source>Ca&amp;ustics Shown As</source>
        <translation>Affichage des causti&amp;ques</translation>
    </message>
    <message>
        <source>Ca&amp;meras</source>
        <translation>Ca&amp;méras</translation>
    </message>
    <message>
        <source>&amp;Panels</source>
        <translation>&amp;Panneaux</translation>
    </message>
    <message>
        <source>&amp;Light</source>
        <translation>&amp;Lumière</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>A&amp;ide</translation>
    </message>
    <message>
        <source>Tools</source>
        <translation>Outils</translation>
    </message>
    <message>
        <source>File progress</source>
        <translation>Avancement du fichier</translation>
    </message>
    <message>
        <source>Cancel opening</source>
        <translation>Annuler l&apos;ouverture</translation>
    </message>
    <message>
        <source>Show the problems of this scene</source>
        <translation>Montrer les problèmes de cette scène</translation>
    </message>
    <message>
        <source>Number of problems</source>
        <translation>Nombre de problèmes</translation>
    </message>
    <message>
        <source>Exposure %1%2 EV</source>
        <translation>Exposition %1%2 IL</translation>
    </message>
    <message>
        <source>Select an object to see the particles that landed on it.</source>
        <translation>Sélectionnez un objet pour voir les particules qui l&apos;ont touché.</translation>
    </message>
    <message>
        <source>All light is shown.</source>
        <translation>Toute la lumière est affichée.</translation>
    </message>
    <message>
        <source>Shown: only %1.</source>
        <translation>Affiché&#xa0;: seulement %1.</translation>
    </message>
    <message>
        <source>There are no measuring points yet: choose Measure Light and click on a surface.</source>
        <translation>Il n&apos;y a pas encore de point de mesure&#xa0;: choisissez Mesurer la lumière et cliquez sur une surface.</translation>
    </message>
    <message numerus="yes">
        <source>%n measuring point(s) copied.</source>
        <translation>
            <numerusform>%n point de mesure copié.</numerusform>
            <numerusform>%n points de mesure copiés.</numerusform>
        </translation>
    </message>
    <message>
        <source>O&amp;verlays</source>
        <translation>&amp;Superpositions</translation>
    </message>
    <message>
        <source>Own axes</source>
        <translation>Axes propres</translation>
    </message>
</context>
<context>
    <name>atrium::ui::MaterialSection</name>
    <message>
        <source>(unnamed material)</source>
        <translation>(matériau sans nom)</translation>
    </message>
    <message>
        <source>Material</source>
        <translation>Matériau</translation>
    </message>
    <message>
        <source>Part</source>
        <translation>Partie</translation>
    </message>
    <message>
        <source>Give the selected objects another material of this scene</source>
        <translation>Donner aux objets sélectionnés un autre matériau de cette scène</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Nom</translation>
    </message>
    <message>
        <source>Rename material</source>
        <translation>Renommer le matériau</translation>
    </message>
    <message>
        <source>Make Unique</source>
        <translation>Rendre unique</translation>
    </message>
    <message>
        <source>Give this part a material of its own, so that changes do not reach other objects</source>
        <translation>Donner à cette partie un matériau à elle, pour que les changements n&apos;atteignent pas d&apos;autres objets</translation>
    </message>
    <message>
        <source>Base colour</source>
        <translation>Couleur de base</translation>
    </message>
    <message>
        <source> %</source>
        <translation>&#xa0;%</translation>
    </message>
    <message>
        <source>Reflectance</source>
        <translation>Réflectance</translation>
    </message>
    <message>
        <source>Metallic</source>
        <translation>Métallique</translation>
    </message>
    <message>
        <source>Roughness</source>
        <translation>Rugosité</translation>
    </message>
    <message>
        <source>Transmission</source>
        <translation>Transmission</translation>
    </message>
    <message>
        <source>Refractive index</source>
        <translation>Indice de réfraction</translation>
    </message>
    <message>
        <source>Double sided</source>
        <translation>Double face</translation>
    </message>
    <message>
        <source>Light colour</source>
        <translation>Couleur de la lumière</translation>
    </message>
    <message>
        <source> cd/m²</source>
        <translation> cd/m²</translation>
    </message>
    <message>
        <source>Luminance</source>
        <translation>Luminance</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1&#xa0;: %2</translation>
    </message>
    <message>
        <source>default</source>
        <translation>par défaut</translation>
    </message>
    <message>
        <source>Default</source>
        <translation>Par défaut</translation>
    </message>
    <message>
        <source>mixed</source>
        <translation>mixte</translation>
    </message>
    <message>
        <source>No material of its own: white, reflectance 80 %.</source>
        <translation>Pas de matériau propre&#xa0;: blanc, réflectance 80&#xa0;%.</translation>
    </message>
    <message>
        <source>Shared by %1 parts; changes reach all of them.</source>
        <translation>Partagé par %1 parties&#xa0;; les changements les atteignent toutes.</translation>
    </message>
    <message>
        <source>%1 materials are changed together.</source>
        <translation>%1 matériaux sont changés ensemble.</translation>
    </message>
    <message>
        <source>Assign material</source>
        <translation>Appliquer le matériau</translation>
    </message>
    <message>
        <source>Make material unique</source>
        <translation>Rendre le matériau unique</translation>
    </message>
</context>
<context>
    <name>atrium::ui::NodeSection</name>
    <message>
        <source>Object</source>
        <translation>Objet</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Nom</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Renommer</translation>
    </message>
    <message>
        <source>Visible</source>
        <translation>Visible</translation>
    </message>
    <message>
        <source>Locked</source>
        <translation>Verrouillé</translation>
    </message>
    <message numerus="yes">
        <source>%n objects selected</source>
        <translation>
            <numerusform>%n objet sélectionné</numerusform>
            <numerusform>%n objets sélectionnés</numerusform>
        </translation>
    </message>
    <message>
        <source>(unnamed)</source>
        <translation>(sans nom)</translation>
    </message>
    <message>
        <source>mixed</source>
        <translation>mixte</translation>
    </message>
</context>
<context>
    <name>atrium::ui::NoticeBar</name>
    <message>
        <source>Put this message away</source>
        <translation>Ranger ce message</translation>
    </message>
</context>
<context>
    <name>atrium::ui::NumberField</name>
    <message>
        <source>mixed</source>
        <translation>mixte</translation>
    </message>
    <message>
        <source>Not changed: %1.</source>
        <translation>Non changé&#xa0;: %1.</translation>
    </message>
    <message>
        <source>Not changed: the value must lie between %1 and %2.</source>
        <translation>Non changé&#xa0;: la valeur doit être entre %1 et %2.</translation>
    </message>
</context>
<context>
    <name>atrium::ui::OverlayController</name>
    <message>
        <source>No light has been computed yet.</source>
        <translation>Aucune lumière n&apos;a encore été calculée.</translation>
    </message>
    <message>
        <source>This light was read from the project, which does not keep elements and links. It can be looked into after the next change of the scene.</source>
        <translation>Cette lumière a été lue dans le projet, qui ne garde ni éléments ni liens. On pourra l&apos;examiner après la prochaine modification de la scène.</translation>
    </message>
    <message>
        <source>The light is still being computed; its elements can be looked at when it is complete.</source>
        <translation>La lumière est encore en cours de calcul ; on pourra voir ses éléments quand elle sera complète.</translation>
    </message>
</context>
<context>
    <name>atrium::ui::PhotometryBox</name>
    <message>
        <source>beam %1°</source>
        <translation>faisceau %1°</translation>
    </message>
    <message>
        <source>beam %1° × %2°</source>
        <translation>faisceau %1° × %2°</translation>
    </message>
    <message>
        <source>%1 lm</source>
        <translation>%1 lm</translation>
    </message>
    <message>
        <source>%1 W</source>
        <translation>%1 W</translation>
    </message>
    <message>
        <source>, </source>
        <translation>, </translation>
    </message>
    <message>
        <source>Choose IES File...</source>
        <translation>Choisir un fichier IES...</translation>
    </message>
    <message>
        <source>Let the lamp shine as its maker measured it. An IES file can also be dropped onto a lamp</source>
        <translation>Faire éclairer la lampe comme son fabricant l&apos;a mesurée. Un fichier IES peut aussi être déposé sur une lampe</translation>
    </message>
    <message>
        <source>Remove</source>
        <translation>Retirer</translation>
    </message>
    <message>
        <source>Shine without a file, with the same flux</source>
        <translation>Éclairer sans fichier, avec le même flux</translation>
    </message>
    <message>
        <source>Different files</source>
        <translation>Fichiers différents</translation>
    </message>
</context>
<context>
    <name>atrium::ui::PhotometryController</name>
    <message>
        <source>Choose Photometric File</source>
        <translation>Choisir un fichier photométrique</translation>
    </message>
    <message>
        <source>Add Luminaire</source>
        <translation>Ajouter un luminaire</translation>
    </message>
    <message>
        <source>Photometric files (*.ies *.IES *.ldt *.LDT);;All files (*)</source>
        <translation>Fichiers photométriques (*.ies *.IES *.ldt *.LDT);;Tous les fichiers (*)</translation>
    </message>
    <message>
        <source>Set photometry</source>
        <translation>Appliquer la photométrie</translation>
    </message>
    <message>
        <source>Lamp</source>
        <translation>Lampe</translation>
    </message>
    <message>
        <source>Add lamp</source>
        <translation>Ajouter une lampe</translation>
    </message>
    <message>
        <source>Photometric File</source>
        <translation>Fichier photométrique</translation>
    </message>
    <message>
        <source>%1 cannot be used.</source>
        <translation>%1 ne peut pas être utilisé.</translation>
    </message>
    <message>
        <source>Let go of the object first.</source>
        <translation>Lâchez d&apos;abord l&apos;objet.</translation>
    </message>
    <message>
        <source>%1: %2</source>
        <translation>%1&#xa0;: %2</translation>
    </message>
</context>
<context>
    <name>atrium::ui::PlacementSection</name>
    <message>
        <source>Placement</source>
        <translation>Placement</translation>
    </message>
    <message>
        <source>Position</source>
        <translation>Position</translation>
    </message>
    <message>
        <source>Rotation</source>
        <translation>Rotation</translation>
    </message>
    <message>
        <source>Scale</source>
        <translation>Échelle</translation>
    </message>
    <message>
        <source>Extent along the axes of the scene: X, Y (height), Z</source>
        <translation>Étendue le long des axes de la scène : X, Y (hauteur), Z</translation>
    </message>
    <message>
        <source>Size</source>
        <translation>Taille</translation>
    </message>
    <message>
        <source>Scene</source>
        <translation>Scène</translation>
    </message>
    <message>
        <source>Group</source>
        <translation>Groupe</translation>
    </message>
    <message>
        <source>Origin and axes of position and rotation: those of the scene, or those of the group that an object is in. Lengths are metres in both.</source>
        <translation>Origine et axes de la position et de la rotation : ceux de la scène, ou ceux du groupe qui contient l&apos;objet. Les longueurs sont en mètres dans les deux cas.</translation>
    </message>
    <message>
        <source>Measured from</source>
        <translation>Repère</translation>
    </message>
    <message>
        <source>Of the object, along its own axes; the scale of its groups comes on top</source>
        <translation>De l&apos;objet, le long de ses propres axes ; l&apos;échelle de ses groupes s&apos;y ajoute</translation>
    </message>
    <message>
        <source>Metres from the origin of the scene, along its axes; Y is up</source>
        <translation>Mètres depuis l&apos;origine de la scène, le long de ses axes ; Y est la hauteur</translation>
    </message>
    <message>
        <source>Metres from the origin of the group, along its axes</source>
        <translation>Mètres depuis l&apos;origine du groupe, le long de ses axes</translation>
    </message>
    <message>
        <source>Degrees about the axes of the scene</source>
        <translation>Degrés autour des axes de la scène</translation>
    </message>
    <message>
        <source>Degrees about the axes of the group</source>
        <translation>Degrés autour des axes du groupe</translation>
    </message>
    <message>
        <source>none</source>
        <translation>aucune</translation>
    </message>
    <message>
        <source>%1 x %2 x %3 m</source>
        <translation>%1 x %2 x %3 m</translation>
    </message>
</context>
<context>
    <name>atrium::ui::PolarDiagram</name>
    <message>
        <source>Polar diagram</source>
        <translation>Diagramme polaire</translation>
    </message>
    <message>
        <source>Luminous intensity over directions; straight down is at the bottom</source>
        <translation>Intensité lumineuse selon la direction&#xa0;; le bas est vers le bas</translation>
    </message>
    <message>
        <source>ring %1 cd</source>
        <translation>cercle %1 cd</translation>
    </message>
    <message>
        <source>all planes</source>
        <translation>tous les plans</translation>
    </message>
</context>
<context>
    <name>atrium::ui::PreferencesDialog</name>
    <message>
        <source>Preferences</source>
        <translation>Préférences</translation>
    </message>
    <message>
        <source>As the system (%1)</source>
        <translation>Comme le système (%1)</translation>
    </message>
    <message>
        <source>&amp;Language:</source>
        <translation>&amp;Langue&#xa0;:</translation>
    </message>
    <message numerus="yes">
        <source>%n second(s) after a change</source>
        <translation>
            <numerusform>%n seconde après un changement</numerusform>
            <numerusform>%n secondes après un changement</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n minute(s) after a change</source>
        <translation>
            <numerusform>%n minute après un changement</numerusform>
            <numerusform>%n minutes après un changement</numerusform>
        </translation>
    </message>
    <message>
        <source>Keep &amp;unsaved work:</source>
        <translation>Garder le travail &amp;non enregistré&#xa0;:</translation>
    </message>
    <message>
        <source>Another language shows when Atrium is started again.</source>
        <translation>Une autre langue s&apos;affiche au prochain démarrage d&apos;Atrium.</translation>
    </message>
    <message>
        <source>As the system</source>
        <translation>Comme le système</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Clair</translation>
    </message>
    <message>
        <source>Dark</source>
        <translation>Sombre</translation>
    </message>
    <message>
        <source>&amp;Colours:</source>
        <translation>&amp;Couleurs :</translation>
    </message>
    <message>
        <source>Light that would take more gets coarser. The Light panel says so.</source>
        <translation>La lumière qui en prendrait plus devient plus grossière. Le panneau Lumière le dit.</translation>
    </message>
    <message>
        <source>Half of this computer&apos;s (%1)</source>
        <translation>La moitié de celle de cet ordinateur (%1)</translation>
    </message>
    <message>
        <source>&amp;Memory for light:</source>
        <translation>&amp;Mémoire pour la lumière :</translation>
    </message>
</context>
<context>
    <name>atrium::ui::ProblemsPanel</name>
    <message>
        <source>Problems</source>
        <translation>Problèmes</translation>
    </message>
    <message>
        <source>Where</source>
        <translation>Où</translation>
    </message>
    <message>
        <source>What, and what to do</source>
        <translation>Quoi, et que faire</translation>
    </message>
    <message>
        <source>No problems found</source>
        <translation>Aucun problème trouvé</translation>
    </message>
    <message>
        <source>Light</source>
        <translation>Lumière</translation>
    </message>
</context>
<context>
    <name>atrium::ui::QualitySection</name>
    <message>
        <source>Quality</source>
        <translation>Qualité</translation>
    </message>
    <message>
        <source>Light quality</source>
        <translation>Qualité de la lumière</translation>
    </message>
    <message>
        <source>Draft: fast</source>
        <translation>Brouillon : rapide</translation>
    </message>
    <message>
        <source>Normal</source>
        <translation>Normale</translation>
    </message>
    <message>
        <source>Fine: slow</source>
        <translation>Fine : lente</translation>
    </message>
    <message>
        <source>One wish for everything: elements, links, rays, mesh, shadows, particles</source>
        <translation>Un seul souhait pour tout : éléments, liens, rayons, maillage, ombres, particules</translation>
    </message>
    <message>
        <source>What the wish stands for in this scene. Every threshold can be set by hand</source>
        <translation>Ce que le souhait signifie dans cette scène. Chaque seuil peut être réglé à la main</translation>
    </message>
    <message>
        <source>Reset to Automatic</source>
        <translation>Revenir à l&apos;automatique</translation>
    </message>
    <message>
        <source>Reset thresholds to automatic</source>
        <translation>Remettre les seuils en automatique</translation>
    </message>
    <message>
        <source>Element size</source>
        <translation>Taille des éléments</translation>
    </message>
    <message>
        <source>Elements of a surface are not divided whose longer edge is below twice this</source>
        <translation>Les éléments d&apos;une surface dont le plus grand côté est inférieur au double ne sont pas divisés</translation>
    </message>
    <message>
        <source>Link threshold</source>
        <translation>Seuil des liens</translation>
    </message>
    <message>
        <source>Share of the light in a room: what goes between two elements is looked at more closely until it is known this well</source>
        <translation>Part de la lumière d&apos;une pièce : ce qui passe entre deux éléments est examiné de plus près jusqu&apos;à être connu aussi bien</translation>
    </message>
    <message>
        <source>Element contrast</source>
        <translation>Contraste des éléments</translation>
    </message>
    <message>
        <source>Elements are divided on which reflected light differs by more than this</source>
        <translation>Les éléments sur lesquels la lumière réfléchie varie davantage sont divisés</translation>
    </message>
    <message>
        <source>Mesh edge</source>
        <translation>Arête du maillage</translation>
    </message>
    <message>
        <source>Edges of the shown mesh are not split below this</source>
        <translation>Les arêtes du maillage affiché ne sont pas divisées en dessous</translation>
    </message>
    <message>
        <source>Mesh contrast</source>
        <translation>Contraste du maillage</translation>
    </message>
    <message>
        <source>Edges of the shown mesh are split whose middle differs by more than this from what is between its ends</source>
        <translation>Les arêtes du maillage affiché sont divisées quand leur milieu diffère davantage de la moyenne de leurs extrémités</translation>
    </message>
    <message>
        <source>Shadow texel</source>
        <translation>Texel d&apos;ombre</translation>
    </message>
    <message>
        <source>How sharp edges of shadows become; taken to the next step of two</source>
        <translation>Finesse des bords d&apos;ombre ; arrondie au pas de deux suivant</translation>
    </message>
    <message>
        <source>Reflection rays</source>
        <translation>Rayons de réflexion</translation>
    </message>
    <message>
        <source>Rays of a first look round for reflected light; where they disagree up to four times as many</source>
        <translation>Rayons d&apos;un premier tour d&apos;horizon pour la lumière réfléchie ; jusqu&apos;à quatre fois plus là où ils divergent</translation>
    </message>
    <message>
        <source>Particles</source>
        <translation>Particules</translation>
    </message>
    <message>
        <source>Sent over mirrors and glass at most</source>
        <translation>Émises au plus vers les miroirs et les verres</translation>
    </message>
    <message>
        <source>Caustic threshold</source>
        <translation>Seuil des caustiques</translation>
    </message>
    <message>
        <source>Standard deviations by which light must be more uneven than chance to get a texture; surfaces may have their own in the caustic inspector</source>
        <translation>Écarts types dont la lumière doit être plus inégale que le hasard pour recevoir une texture ; les surfaces peuvent avoir le leur dans l&apos;inspecteur de caustiques</translation>
    </message>
    <message>
        <source>Thresholds: automatic</source>
        <translation>Seuils : automatiques</translation>
    </message>
    <message numerus="yes">
        <source>Thresholds: %n set by hand</source>
        <translation>
            <numerusform>Seuils : %n réglé à la main</numerusform>
            <numerusform>Seuils : %n réglés à la main</numerusform>
        </translation>
    </message>
    <message>
        <source>%1 to %2 are possible: %3 is used</source>
        <translation>De %1 à %2 possible : %3 est utilisé</translation>
    </message>
</context>
<context>
    <name>atrium::ui::RecoveryDialog</name>
    <message numerus="yes">
        <source>%1 and %n more</source>
        <translation>
            <numerusform>%1 et %n autre</numerusform>
            <numerusform>%1 et %n autres</numerusform>
        </translation>
    </message>
    <message>
        <source>Recovered work</source>
        <translation>Travail récupéré</translation>
    </message>
    <message>
        <source>Atrium did not end properly. Work that was not saved has been kept.</source>
        <translation>Atrium ne s&apos;est pas terminé normalement. Le travail non enregistré a été gardé.</translation>
    </message>
    <message>
        <source>Work that was not saved: kept after a crash, or given up in the last two weeks.</source>
        <translation>Travail non enregistré&#xa0;: gardé après un arrêt brutal, ou abandonné ces deux dernières semaines.</translation>
    </message>
    <message>
        <source>Untitled</source>
        <translation>Sans titre</translation>
    </message>
    <message>
        <source>%1, %2, reverted</source>
        <translation>%1, %2, abandonné</translation>
    </message>
    <message>
        <source>%1, %2, discarded</source>
        <translation>%1, %2, rejeté</translation>
    </message>
    <message>
        <source>%1, %2</source>
        <translation>%1, %2</translation>
    </message>
    <message>
        <source>Picture of the saved file</source>
        <translation>Image du fichier enregistré</translation>
    </message>
    <message>
        <source>Picture of the recovered work</source>
        <translation>Image du travail récupéré</translation>
    </message>
    <message>
        <source>Open Recovered</source>
        <translation>Ouvrir le travail récupéré</translation>
    </message>
    <message>
        <source>Open Saved File</source>
        <translation>Ouvrir le fichier enregistré</translation>
    </message>
    <message>
        <source>Delete Recovered</source>
        <translation>Supprimer le travail récupéré</translation>
    </message>
    <message>
        <source>Later</source>
        <translation>Plus tard</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Fermer</translation>
    </message>
    <message>
        <source>Saved: %1
%2</source>
        <translation>Enregistré&#xa0;: %1
%2</translation>
    </message>
    <message>
        <source>Saved: never</source>
        <translation>Enregistré&#xa0;: jamais</translation>
    </message>
    <message>
        <source>Saved: the file is gone
%1</source>
        <translation>Enregistré&#xa0;: le fichier a disparu
%1</translation>
    </message>
    <message>
        <source>Recovered: %1</source>
        <translation>Récupéré&#xa0;: %1</translation>
    </message>
    <message>
        <source>Drawing...</source>
        <translation>Dessin en cours...</translation>
    </message>
    <message>
        <source>There is no saved file.</source>
        <translation>Il n&apos;y a pas de fichier enregistré.</translation>
    </message>
    <message>
        <source>The saved file is newer than the recovered work.</source>
        <translation>Le fichier enregistré est plus récent que le travail récupéré.</translation>
    </message>
    <message>
        <source>Both hold the same objects in the same places.</source>
        <translation>Les deux contiennent les mêmes objets aux mêmes endroits.</translation>
    </message>
    <message>
        <source>Changed in the recovered work: %1</source>
        <translation>Changé dans le travail récupéré&#xa0;: %1</translation>
    </message>
    <message>
        <source>Only in the recovered work: %1</source>
        <translation>Seulement dans le travail récupéré&#xa0;: %1</translation>
    </message>
    <message>
        <source>Only in the saved file: %1</source>
        <translation>Seulement dans le fichier enregistré&#xa0;: %1</translation>
    </message>
</context>
<context>
    <name>atrium::ui::SceneSection</name>
    <message>
        <source>Scene</source>
        <translation>Scène</translation>
    </message>
    <message>
        <source>Sky colour</source>
        <translation>Couleur du ciel</translation>
    </message>
    <message>
        <source> cd/m²</source>
        <translation> cd/m²</translation>
    </message>
    <message>
        <source>Sky luminance</source>
        <translation>Luminance du ciel</translation>
    </message>
    <message>
        <source>The scene is empty. The Add menu puts in shapes, lamps and cameras.</source>
        <translation>La scène est vide. Le menu Ajout y met formes, lampes et caméras.</translation>
    </message>
    <message>
        <source>%1 objects, %2 materials</source>
        <translation>%1 objets, %2 matériaux</translation>
    </message>
    <message>
        <source>, %1 x %2 x %3 m</source>
        <translation>, %1 x %2 x %3 m</translation>
    </message>
</context>
<context>
    <name>atrium::ui::SceneTreeModel</name>
    <message>
        <source>(unnamed)</source>
        <translation>(sans nom)</translation>
    </message>
    <message>
        <source>Hide this object</source>
        <translation>Masquer cet objet</translation>
    </message>
    <message>
        <source>Show this object</source>
        <translation>Afficher cet objet</translation>
    </message>
    <message>
        <source>Unlock this object</source>
        <translation>Déverrouiller cet objet</translation>
    </message>
    <message>
        <source>Lock this object against picking and moving</source>
        <translation>Verrouiller cet objet contre la sélection et le déplacement</translation>
    </message>
    <message>
        <source>visible</source>
        <translation>visible</translation>
    </message>
    <message>
        <source>hidden</source>
        <translation>masqué</translation>
    </message>
    <message>
        <source>locked</source>
        <translation>verrouillé</translation>
    </message>
    <message>
        <source>not locked</source>
        <translation>non verrouillé</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Renommer</translation>
    </message>
    <message>
        <source>Move in tree</source>
        <translation>Déplacer dans l&apos;arbre</translation>
    </message>
</context>
<context>
    <name>atrium::ui::SceneTreePanel</name>
    <message>
        <source>Filter objects</source>
        <translation>Filtrer les objets</translation>
    </message>
    <message>
        <source>Filter objects by name</source>
        <translation>Filtrer les objets par nom</translation>
    </message>
    <message>
        <source>Scene tree</source>
        <translation>Arbre de la scène</translation>
    </message>
    <message>
        <source>Hide</source>
        <translation>Masquer</translation>
    </message>
    <message>
        <source>Show</source>
        <translation>Afficher</translation>
    </message>
    <message>
        <source>Unlock</source>
        <translation>Déverrouiller</translation>
    </message>
    <message>
        <source>Lock</source>
        <translation>Verrouiller</translation>
    </message>
</context>
<context>
    <name>atrium::ui::Section</name>
    <message>
        <source>Change %1</source>
        <translation>Changer %1</translation>
    </message>
</context>
<context>
    <name>atrium::ui::ShapeSection</name>
    <message>
        <source>Shape</source>
        <translation>Forme</translation>
    </message>
    <message>
        <source>Width (X)</source>
        <translation>Largeur (X)</translation>
    </message>
    <message>
        <source>Height (Y)</source>
        <translation>Hauteur (Y)</translation>
    </message>
    <message>
        <source>Depth (Z)</source>
        <translation>Profondeur (Z)</translation>
    </message>
    <message>
        <source>Width</source>
        <translation>Largeur</translation>
    </message>
    <message>
        <source>Depth</source>
        <translation>Profondeur</translation>
    </message>
    <message>
        <source>Radius</source>
        <translation>Rayon</translation>
    </message>
    <message>
        <source>Disc radius</source>
        <translation>Rayon du disque</translation>
    </message>
    <message>
        <source>Cylinder radius</source>
        <translation>Rayon du cylindre</translation>
    </message>
    <message>
        <source>Cylinder height</source>
        <translation>Hauteur du cylindre</translation>
    </message>
    <message>
        <source>Base radius</source>
        <translation>Rayon de la base</translation>
    </message>
    <message>
        <source>Top radius</source>
        <translation>Rayon du sommet</translation>
    </message>
    <message>
        <source>Cone height</source>
        <translation>Hauteur du cône</translation>
    </message>
    <message>
        <source>Closed ends</source>
        <translation>Extrémités fermées</translation>
    </message>
    <message>
        <source>Shapes of several kinds</source>
        <translation>Formes de plusieurs types</translation>
    </message>
    <message>
        <source>Mesh: %1 triangles, %2 part(s)</source>
        <translation>Maillage&#xa0;: %1 triangles, %2 partie(s)</translation>
    </message>
    <message>
        <source>Polygon: %1 corners, %2 hole(s)</source>
        <translation>Polygone&#xa0;: %1 sommets, %2 trou(s)</translation>
    </message>
    <message>
        <source>, shared by %1 objects</source>
        <translation>, partagé par %1 objets</translation>
    </message>
</context>
<context>
    <name>atrium::ui::StartPage</name>
    <message>
        <source>Edit an interior and see its light follow.</source>
        <translation>Composez un intérieur et voyez la lumière suivre.</translation>
    </message>
    <message>
        <source>Sample Room</source>
        <translation>Pièce d&apos;exemple</translation>
    </message>
    <message>
        <source>Open a furnished room to try things out</source>
        <translation>Ouvrir une pièce meublée pour essayer</translation>
    </message>
    <message>
        <source>Open File</source>
        <translation>Ouvrir un fichier</translation>
    </message>
    <message>
        <source>New Scene</source>
        <translation>Nouvelle scène</translation>
    </message>
    <message>
        <source>Recent files</source>
        <translation>Fichiers récents</translation>
    </message>
    <message>
        <source>glTF (.gltf, .glb) and Atrium (.atrium) files can also be dropped onto this window.</source>
        <translation>Les fichiers glTF (.gltf, .glb) et Atrium (.atrium) peuvent aussi être déposés sur cette fenêtre.</translation>
    </message>
    <message>
        <source>%1   in %2</source>
        <translation>%1   dans %2</translation>
    </message>
</context>
<context>
    <name>atrium::ui::ViewportWidget</name>
    <message>
        <source>3D view</source>
        <translation>Vue 3D</translation>
    </message>
    <message>
        <source>Walk: W A S D to go, drag to look, Q E lower or raise the eye, Shift faster, Esc leaves</source>
        <translation>Marche&#xa0;: W A S D pour avancer, glisser pour regarder, Q E pour baisser ou lever l&apos;œil, Maj plus vite, Échap quitte</translation>
    </message>
    <message>
        <source>There is no surface in the middle of the view.</source>
        <translation>Il n&apos;y a pas de surface au milieu de la vue.</translation>
    </message>
    <message>
        <source>Select an object first.</source>
        <translation>Sélectionnez d&apos;abord un objet.</translation>
    </message>
    <message>
        <source>Nothing lies below the selection, or it is locked.</source>
        <translation>Rien sous la sélection, ou elle est verrouillée.</translation>
    </message>
    <message>
        <source>Drop to surface</source>
        <translation>Poser sur la surface</translation>
    </message>
    <message>
        <source>The selection rests already.</source>
        <translation>La sélection repose déjà.</translation>
    </message>
    <message>
        <source>Lowered by %1 m</source>
        <translation>Descendu de %1 m</translation>
    </message>
    <message>
        <source>Only the selection is shown; its light is that of the whole scene.</source>
        <translation>Seule la sélection est affichée&#xa0;; sa lumière est celle de toute la scène.</translation>
    </message>
    <message>
        <source>The 3D view needs OpenGL 3.3. Update the graphics driver, or start with software rendering: LIBGL_ALWAYS_SOFTWARE=1</source>
        <translation>La vue 3D a besoin d&apos;OpenGL 3.3. Mettez à jour le pilote graphique, ou démarrez en rendu logiciel&#xa0;: LIBGL_ALWAYS_SOFTWARE=1</translation>
    </message>
</context>
</TS>
