#pragma once
// Every tolerance and threshold of the project, with its unit and its reason.

#include <cstddef>
#include <cstdint>

namespace yadefrag::tolerance {

/// (relative) Added to the largest box of a level before it is subtracted from a coordinate: covers
/// the rounding of the two subtractions (2⁻⁵³ each) with a factor of eight to spare.
inline constexpr double kExtentRounding = 8.9e-16;

/// (ratio) Edge of a position-code box over the longest body box of its level. Above 1, a box that
/// overlaps another starts in the same position-code box or the next, which the search relies on.
/// The greater, the fewer ranges and the more candidates: see tests/benchmark.
inline constexpr double kEdgeOverExtent = 2;

/// (ratio) The longest side of a level is planned by this much above the longest of the sample, so
/// that bodies of one size, which differ by rounding and by their sweeps, do not straddle two
/// levels.
inline constexpr double kSpareSide = 1.1;

/// (count) Levels with no more boxes than this are not put on the curve but tested against
/// everything: a floor and four walls would otherwise cost every body a range search each.
inline constexpr std::size_t kWideLevelCount = 8;

/// (count) Codes in one bucket of the directory above which the bucket gets a directory of its own.
inline constexpr std::size_t kBucketCodes = 16;

/// (boxes) Up to this width on every axis a rectangle is cut once an axis (paper §4.4); a larger
/// one is cut until its ranges hold little else.
inline constexpr double kSmallRectangle = 3;

/// (boxes) Up to this many per occupied position-code box of twice the edge, a level is joined to
/// the next coarser one.
inline constexpr double kThinLevel = 1.5;

/// (ratio) From this many boxes on a finer level per box on a coarser one, the coarse ones search.
inline constexpr std::size_t kFinePerCoarse = 4;

/// (boxes) An axis along which all boxes start within this many median box lengths is left out of
/// the position code: a plane scene is searched with 2D codes.
inline constexpr double kFlatAxis = 1.0;

/// (ratio) Codes that a range of a large rectangle may hold for each of its boxes: a sliver's two
/// end codes can have the whole scene between them.
inline constexpr std::uint64_t kCodesPerBox = 4;

/// (count) Fewer items than this are not worth waking a second thread for.
#ifdef YADEFRAG_ITEMS_PER_THREAD  // the thread sanitizer is to see threads in small scenes
inline constexpr std::size_t kMinItemsPerThread = YADEFRAG_ITEMS_PER_THREAD;
#else
inline constexpr std::size_t kMinItemsPerThread = 512;
#endif

/// (ratio) The hierarchy is rebuilt when the summed half-perimeter of its refitted nodes exceeds
/// this many times what it was when built.
inline constexpr double kHierarchyDecay = 1.5;

/// (count) Boxes in a leaf of the hierarchy.
inline constexpr std::uint32_t kHierarchyLeaf = 4;

/// (relative to coordinates) Covers the rounding of the test of the true halo and of YADE's
/// geometry functors, so that balls that touch to the last bit are not lost where there is no
/// sweep.
inline constexpr double kHaloRounding = 2e-15;

/// (count) Rows of a table of pairs that are longer are sorted and halved to find a pair: below
/// that a look at each is as fast. Few bodies of an even packing have as many neighbours.
inline constexpr std::size_t kLongRow = 16;

/// (relative to squared lengths) A period vector is taken for shorter than another only beyond
/// rounding, so that equal ones do not take turns.
inline constexpr double kShorterPeriod = 1e-12;

/// (cells) Largest shear of a periodic cell. Reduced vectors lose as many digits as it has.
inline constexpr double kMostShear = 1e6;

/// (bytes) Memory of a potential interaction with its pair in the search, and what contact adds to
/// it (measured: 417; 380 to 660).
inline constexpr double kPairBytes = 420, kContactBytes = 650;

/// (count) Pairs per body of which few are contacts; where there are more, bodies lie on one
/// another and all of them may be.
inline constexpr double kUsualPairs = 20;

/// (count; ratio) Bodies below which all pairs fit any memory, and how much their number may grow
/// before the free memory is looked up again.
inline constexpr std::size_t kFewBodies = 4000;
inline constexpr double kMemoryLookUp = 1.1;

/// (ratio) Spare in the length of a sweep for acceleration: without it a body at constant speed
/// calls for a search one step early.
inline constexpr double kSweepSpare = 1.02;

/// (steps) Shortest and longest interval between searches that is aimed at.
inline constexpr double kLeastInterval = 3, kMostInterval = 200;

/// (ratio) Growth of the interval from one search to the next. Growth is blind: in a dense block a
/// whole shell of further neighbours comes near at once. Small steps overshoot little.
inline constexpr double kIntervalGrowth = 1.25;

/// (ξ) A Newton step of the foot on an arc that is as short as this was the last: ξ itself is known
/// to a few roundings only.
inline constexpr double kFootStep = 1e-15;

/// (count) Steps for the foot on an arc: halving alone gets from 1 to `kFootStep` in 50.
inline constexpr int kMostFootSteps = 100;

/// (count) Halvings of an arc that isolate its orthogonal feet; two that are nearer than 2⁻²⁰ are
/// one.
inline constexpr int kMostArcCuts = 20;

/// (relative to the chord) Rounding that the quick line test of a boundary piece forgives.
inline constexpr double kQuickLine = 1e-14;

/// (squared length of the sum of two unit vectors) A corner folded nearer to 180° than 10⁻⁶ rad has
/// no normal between its two sides'.
inline constexpr double kFold = 1e-12;

/// (of a piece's length) Slaves this little inside a master when they first come near count as
/// outside: bodies laid exactly on one another differ by rounding.
inline constexpr double kTouching = 1e-9;

/// (of the coordinates) The same where coordinates are large: what a few of their roundings are.
inline constexpr double kTouchRounding = 0x1p-50;

/// (rad) A node whose triangles fill more of its surroundings is the tip of a notch or a crack: a
/// straight boundary fills π, and a deformed or rounded one some degrees more.
inline constexpr double kTipAngle = 3.46;

/// (of a side) Ends of sides that are bonded are no farther apart: what the bond pulls together in
/// its first step strains a body by no more.
inline constexpr double kBondGap = 1e-9;
/// (of a side) Sides that run along each other, no farther apart, but do not match: meant to.
inline constexpr double kBondMeant = .01;

/// (rad) A corner that turns by more is a slave in a single pass too: 30°.
inline constexpr double kSharpCorner = .52;

/// (1/octave) Surfaces whose mean piece lengths are equal when rounded to this part of an octave
/// count as equally fine, so that deformation does not make slaves and masters take turns.
inline constexpr double kFinenessSteps = 8;

/// (ξ) A foot this far beyond a piece's end is still on it: at a joint of two pieces, rounding must
/// not leave a slave between them.
inline constexpr double kFootRange = 1e-9;

/// (cosine) A slave's normal and its master's must be opposed by more than this: at coincident
/// corners the lateral faces, parallel to rounding, take no part.
inline constexpr double kOpposed = -.1;

/// (sine) A sharp convex corner, one that turns by more than kSameFace, touches a face as long as
/// neither of its sides leans through that face by more than 30°. At 6° contacts that tilt are
/// dropped and come back as overlaps: in impacts contact then created ten times as much energy.
inline constexpr double kLeansIn = .5;

/// (of the reach, which is twice the largest displacement) In rubble a slave that was outside and
/// is left this little inside by rounding or by the others' correction is still the master's. With
/// half or twice of it one impact in twelve had pieces that overlap by more than half a segment;
/// with ten times as much, corners that had gone round a master's end were pushed back, and contact
/// created ten times as much energy.
inline constexpr double kLeftInside = .02;

/// (ξ) Farthest beyond a piece's end that the foot at xⁿ may be for the force to act at that foot,
/// which keeps the angular momentum; the shape functions go on linearly.
inline constexpr double kFootBeyond = .25;

/// (cosine) Two neighbouring pieces whose normals differ by less than 30° are one face for a slave
/// that slides from one to the other.
inline constexpr double kSameFace = .866;

/// (of the largest displacement in the step; of the shortest segment) Penetration that is left by
/// the second-order remainder of the linearised condition and not worth another solve: an error of
/// so much in velocities, and what rounding leaves.
inline constexpr double kRemainder = 1e-5, kPenetrationLeft = 1e-10;

/// (count) Most detections in one step.
inline constexpr int kDetections = 10;

/// (ratio) An overlap older than its contact is let out by this part in every step, and by no more
/// than this part of the largest displacement: all at once it
/// would become a velocity, and energy out of nothing.
inline constexpr double kOverlapDecay = .02;

/// (relative to the largest bound) Change of the friction bounds at which their iteration ends, and
/// how often it may go round.
inline constexpr double kFrictionBound = 1e-4;
inline constexpr int kFrictionRounds = 8;

/// (count; of the largest displacement in the step) Contact in rubble is solved by so many sweeps
/// at each of so many detections, until they change so little. With twice as many detections and a
/// hundredth of the change, what an impact spends in friction and in touching is the same within
/// what other strengths make of it; with a single detection touching takes half as much.
inline constexpr int kRowSweeps = 20, kRubbleDetections = 2;
inline constexpr double kRubbleRemainder = 1e-3;

/// (rows; of the penetration that is worth another solve; count) A group with friction and more
/// rows than the first is solved by sweeps, until no gap or slip changes by more than the second,
/// or for so many sweeps.
inline constexpr std::size_t kPivotedRows = 8;
inline constexpr double kSweptChange = .1;
inline constexpr int kGroupSweeps = 200;

/// (ratio) Normal forces above this many times the largest that one row of their group needs by
/// itself are a jam's, and bound friction no further.
inline constexpr double kJam = 100;

/// (of the shorter of the two segments) Farthest that bodies about to touch may move against each
/// other in one step: halos of adjacent segments must not overlap, for the same reason (§4.1).
inline constexpr double kMostMotion = .5;

/// (of the shortest segment) Farthest that any surface node may move in one step: with a halo for
/// more, everything would be a candidate of everything. Ten wave speeds and more.
inline constexpr double kFarthestMove = 10;

/// (of the bodies' largest energy; ratio) What contact or cracks may have given before a sentence
/// says so, and growth of it for which energies are looked at again.
inline constexpr double kGivenEnergy = .01, kLookAgain = 1.1;

/// (steps) From one look at the kinetic energy to the next: half a per cent of a step's work each.
inline constexpr std::uint64_t kStepsToLook = 8;

/// (steps) From one sum over all energies to the next: it takes as long as four steps.
inline constexpr std::uint64_t kStepsToSumUp = 1024;

/// (count; steps) A step that has changed more often than this, and more than once in so many
/// steps, may feed vibrations.
inline constexpr std::uint64_t kFewChanges = 2, kStepsPerChange = 1000;

/// (relative) Rounding of a coordinate in a step. Energies of bodies at rest are a twentieth of
/// what it gives, at any distance from the origin and any step.
inline constexpr double kRounding = 0x1p-53;

/// (of the shortest segment) Penetration left in a step above which a sentence says so; half a halo
/// if that is less, for beyond the halo smooth surfaces hold nothing.
inline constexpr double kDeep = .1;

/// (of the shortest segment) The halo's width: at most half, so that three adjacent halos do not
/// overlap (paper §4.1); at least a twentieth, below which nothing is saved.
inline constexpr double kWidestHalo = .5, kNarrowestHalo = .05;

/// (steps) For how many a halo is made wide enough at the present largest velocity.
inline constexpr double kHaloSteps = 40;

/// (ratio) Spare for acceleration when it is foreseen whether the next step leaves the halo.
inline constexpr double kHaloSpare = 1.1;

/// (of the reach within which nobody may be) A body is apart from others that are farther than
/// `kApart`, so that not every look finds another choice; gaps up to `kApartLook` are looked at,
/// which a body eats up in some hundred steps.
inline constexpr double kApart = 2, kApartLook = 8;

/// (of the largest move in a step) Reach of bodies that are apart, if that is more than the halo:
/// even two that fly towards each other are seen well before they could meet.
inline constexpr double kApartMoves = 8;

/// (ratio) Spare for acceleration until all velocities are looked at again: steps in which nobody
/// is faster need no look at the nodes.
inline constexpr double kSpeedSpare = 1.25;

/// (m/s) Nobody is fast below this if nothing else is said; its square and its way are finite.
/// Bodies may not be sent at more.
inline constexpr double kAnySpeed = 1e100;

/// (1) Largest coefficients of bulk viscosity: usual ones are 0.06 and 1.2, and the critical step
/// falls in proportion.
inline constexpr double kMostViscosity = 1e6;

/// (det F; of the least stress-free height) An element that is compressed to `kFlat` of its area is
/// flat. Only a flat element, or one whose nodes move by `kSwift` or more, can be turned inside out
/// in one step; elements that were stretched as well are the exception.
inline constexpr double kFlat = .2, kSwift = .1;

/// (count) Boxes that are sooner compared with each other than sorted.
inline constexpr std::size_t kFewBoxes = 12;

/// (count) Elements whose forces are summed in one go: their nodes stay in the first-level cache,
/// and few of them belong to another chunk too.
inline constexpr std::size_t kChunkElements = 512;

/// (ratio) Elements stressed to this part of their body's lowest strength are looked at more
/// closely: the stress is that of the step before.
inline constexpr double kStrengthLook = .9;

/// (count) Fewer elements than this per thread are not worth two meetings of the threads a step.
inline constexpr std::size_t kElementsPerThread = 4 * kMinItemsPerThread;

/// (count) Nodes whose works are summed in one go: sums do not depend on the number of threads.
inline constexpr std::size_t kNodesPerSum = 2048;

/// (count) Triangles above this many are not counted by 32-bit numbers with a sign to spare.
inline constexpr double kMostTriangles = 2147483648.;

/// (bytes) Of memory that a triangle takes at the least, all told, in its first step: measured in
/// squares of 10⁵ to 6·10⁵.
inline constexpr double kTriangleBytes = 400;

/// (count) Triangles whose masses and stiffnesses are summed in a node without leaving the range of
/// numbers.
inline constexpr double kMostSummed = 1000;

/// (of the largest coordinate) Smallest size of triangles: below, twelve bits of their sides would
/// be left of the coordinates' 52.
inline constexpr double kLeastSize = 0x1p-40;

/// (of the largest coordinate) Least way in a step that a body may be sent at: 16 roundings.
inline constexpr double kSeenMotion = 0x1p-49;

/// (rad) A triangle with a smaller angle has no area to speak of: of its 52 bits, about half are
/// rounding.
inline constexpr double kLeastAngle = 1e-8;

/// (tangent) Of the smallest angle, 35°, from which on nodes are moved to even the triangles out,
/// though a smallest angle may shrink down to this.
inline constexpr double kGoodTan = .7;

/// (of the mean side around a node) Least height of the triangles at a scattered node from which on
/// it is not moved for their sake. At .5 steps are 5 % shorter; at .6 angles fall below 30°.
inline constexpr double kGoodHeight = .55;

/// (ratio) A critical step that is shorter than an even lattice's by this factor is worth a
/// warning; irregular meshes have up to 1.5.
inline constexpr double kCostlyStep = 3;

/// (m/m) Growth of the wanted edge length with the distance from a boundary of shorter edges.
inline constexpr double kEdgeGrowth = .25;

/// (of the wanted edge length) A new node keeps this distance from all others, and this one from
/// the boundary's edges; a regular layout has 1 and 0.87.
inline constexpr double kNodeClearance = .75, kBoundaryClearance = .6;

/// (of the squared tolerance) By how much equal costs of vertices that an outline could do without
/// get different values, so that their order is the same in every run.
inline constexpr double kEqualCosts = 1e-6;

/// (of the size there) A joint that ends this near the outline or another joint ends on it: the
/// places where lines meet are known to rounding only.
inline constexpr double kJointMeets = 1e-6;

/// (of an edge's length) A point this near an edge of the boundary may be one that divides it.
inline constexpr double kOnEdge = 1e-9;

/// (of the product of the four sides) An edge is flipped when the angles across it exceed 180° by
/// more than rounding, so that two equal choices do not take turns.
inline constexpr double kFlip = 1e-9;

/// (relative to max |g|) Error of the forces of a contact group, besides rounding: below what the
/// linearisation leaves. Smaller ones cost Gauss–Seidel sweeps in two-pass systems with friction.
inline constexpr double kBoxResidual = 1e-9;

/// (of the product of their diagonals) Two rows with a determinant above this are solved in closed
/// form.
inline constexpr double kIndependentRows = 1e-6;

/// (relative to the diagonal) Proximal regularisation of a group's matrix; the next where pivoting
/// cycles with the one before.
inline constexpr double kProximal[] = {1e-7, 1e-5, 1e-3};

/// (relative to the diagonal; count) The same for a group that has no solution, and how often it is
/// taken out again: a force grows by 1/(2ε) of what would close the gap each time.
inline constexpr double kCompromise = 1e-2;
inline constexpr int kCompromiseSteps = 5;

/// (relative to max |g|) A bound or a sign violated by less than this is no reason for a pivot.
inline constexpr double kPivotSlack = 1e-15;

/// (count) Pivots of all contradicted rows at once that may fail to reduce their number.
inline constexpr int kBlocksWithoutGain = 3;

/// (part of a Newton step) Below this a step that lowers the energy is lost in rounding.
inline constexpr double kLeastDescent = 1e-9;

/// (count) Factors of one solve after which the next regularisation is tried.
inline constexpr int kMostPivots = 300;

/// (count) Proximal iterations, and how many of them must at least halve the error.
inline constexpr int kMostRefinements = 200, kRefinementsToHalve = 10;

/// (count) Gauss–Seidel sweeps where all else fails, and between two looks at the error.
inline constexpr int kMostSweeps = 100, kSweepsToCheck = 10;

/// (rows) Up to the first a group's matrix is factored by plain loops, up to the second as a dense
/// one; up to the third if more than a quarter of its entries are there.
inline constexpr std::size_t kPlainCholesky = 16, kDenseRows = 32, kMostDenseRows = 1500;

/// (of the strength; count) Change of cohesive tractions at which the sweeps over those that share
/// nodes end, and how many there may be. With ten times the first a plate's cracks spend 0.2 %
/// less; with thirty times the second the same to 10⁻⁵.
inline constexpr double kCohesionChange = 1e-6;
inline constexpr int kCohesionSweeps = 100;

/// (count; squared cosine; ratio) After every so many sweeps but the last ones, changes that point
/// the same way as those before are summed up as the geometric series that they are, with at most
/// this ratio. Two cracks beside each other whose lines are stiff come nearer by a thousandth a
/// sweep else, and seven times as many sweeps leave ten times the residual. With a ratio of .999
/// sums of what is no series leave 0.02 of the strength instead of 0.001.
inline constexpr int kSweepsToSumUp = 3, kSweepsToSettle = 20;
inline constexpr double kSameChange = .99, kMostRatio = .99;

/// (of the opening and what the tractions take from it; count) A Newton step of an opening in mixed
/// mode that is as short as this was the last; three or four are usual.
inline constexpr double kOpeningStep = 1e-14;
inline constexpr int kMostOpeningSteps = 30;

/// (one in so many) Room for nodes that cracks add, beside those that are there.
inline constexpr std::size_t kSpareNodes = 8;

}  // namespace yadefrag::tolerance
