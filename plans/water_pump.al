; The water pump of 1973, assembled in eleven stages. A twelfth stage inspects the whole assembly, as late as it can.
;
; The comments in capitals, and the instructions beside them, stand in the listing of 1973; water_pump_1973.al does each thing
; once. This one is careful: what can be tried again is tried again before the operator is called, and each stage ends with
; a check of what it could have done wrong.
; Inches, ounces, degrees. Positions are taught, in the file beside this one.

; The base is not seen: the arm's shadow may lie on it. Up to two pictures more, the arm in another posture for each.
DEFINE ELSEWHERE AGAIN ON WHAT
        SOJG    SECOND BESIDE
        SOJG    THIRD BEHIND
        WAIT    "THE BASE IS NOT SEEN ON THE BELT: ITS {WHAT}"
        JUMP    ON
BESIDE: MOVE    ASIDE
        JUMP    AGAIN
BEHIND: MOVE    BACK
        JUMP    AGAIN

; A screw from its place in the dispenser: the socket over its head, then down to it.
DEFINE FETCH S
        SEARCH  .05
M:      SKIPN   6               ;all places tried
        WAIT    "THE BIT FINDS NO SCREW AT {S}: IT IS LOST, OR THE DISPENSER HAS MOVED, OR A JOINT READS WRONG"
        MOVE    S
        RESTORE DRX
        RESTORE DRV
        RESTORE DS LEVEL
        STOP    [0 0 -25]
        FREE    [1 1 0]         ;let the head guide the socket
        CHANGE  [0 0 -1] .5 .4
        SKIPN   23
        WAIT    "NO SCREW AT {S}: IT IS MISSING, OR THE DISPENSER HAS MOVED, OR A JOINT READS WRONG"
        TRAVEL  .17 .40         ;socket over the head, or beside it?
        SKIPE   8
        JUMP    OVER
        HEIGHT  RIM -.05 .05    ;as high as over the last one? On the edge of a head it stands .1 in higher
        SKIPN   9
        AOJ     M
OVER:   SAVE    RIM
        STOP    [0 0 -45]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .3 .2  ;and on to the head, where its edge has met the ring
        SAVE    DS
        FREE    [1 1 0]
        CHANGE  [0 0 1] .8      ;its hole guides the screw out, and the screw the socket: else it hangs askew
        CHANGE  [0 0 1] .7

; That screw once more, when the hand came without it: the socket stood on the edge of its head, .1 in higher than over it.
DEFINE REFETCH S NR
        SEARCH  .05
R:      SKIPN   6               ;all places tried
        WAIT    "SCREW {NR} IS NOT ON THE BIT"
        MOVE    S
        RESTORE DRX
        RESTORE DRV
        STOP    [0 0 -25]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5 .4
        SKIPN   23
        WAIT    "NO SCREW AT {S}: IT IS MISSING, OR THE DISPENSER HAS MOVED, OR A JOINT READS WRONG"
        HEIGHT  RIM -.2 -.05    ;lower than it stood before?
        SKIPN   9
        AOJ     R
        STOP    [0 0 -45]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .3 .2
        SAVE    DS
        FREE    [1 1 0]
        CHANGE  [0 0 1] .8      ;its hole guides the screw out, and the screw the socket: else it hangs askew
        CHANGE  [0 0 1] .7

; How high does the socket stand on the head that it is over? The hand lifts it off, and comes down slowly. Only such touches can
; be compared: as the driver turns, it may press with 0 to 44 oz, which are .09 in.
DEFINE SEAT
        CHANGE  [0 0 1] .15     ;its ring off the head, where the touch takes its zero
        STOP    [0 0 -40]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5 .1  ;on from the edge of a head, too

; That screw into a hole, to the torque stop: fetched once more if it was not on the bit, driven up to four times in all.
DEFINE SCREW S H ACROSS NR
        ASSIGN  TAKEN 2
        ASSIGN  STAYS 2
        FETCH   S
TRY:    ASSIGN  N 4
        SEARCH  .05
K:      SKIPN   6
        WAIT    "SCREW {NR} FINDS NO HOLE AT {H}: POINT OR HOLE IS WRONG, OR A JOINT READS WRONG"
        MOVE    H
        RESTORE ACROSS          ;where the pin at that end of the base stands
        RESTORE X2
        RESTORE HS LEVEL        ;one hole found helps to find the others
        STOP    [0 0 -30]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .45
        SKIPE   23              ;no resistance: the tip is in the hole
        AOJ     K
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the hole guide the tip
        CHANGE  [0 0 -1] .48 .4 ;down to the thread
        SKIPE   23
        JUMP    DOWN
        CHANGE  [0 0 1] 1       ;no resistance: it has stayed in the dispenser, or is lost
        SOJG    TAKEN ANEW
        SOJG    STAYS LOST
        WAIT    "SCREW {NR} STAYS IN ITS HOLE WITHOUT TORQUE: ITS POINT, ITS THREAD OR THE BIT IS WRONG, OR NO TOP IS UNDER IT"
LOST:   WAIT    "SCREW {NR} IS NOT ON THE BIT: IT IS LOST, OR LOOSE IN ITS HOLE"
ANEW:   REFETCH S NR
        JUMP    TRY
DOWN:   HEIGHT  DS -.02 .22     ;a screw stands .1 in higher at the mouth of its thread than in the dispenser
        SKIPE   9
        JUMP    TURN
        CHANGE  [0 0 1] .6
        SEARCH  .05
        SOJG    N K
        WAIT    "SCREW {NR} STANDS WRONG: ITS LENGTH, ITS POINT OR ITS HOLE IS WRONG"
TURN:   SAVE    HS
        TOOL    190
        TORQUE  42
        FORCE   [0 0 -22]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5     ;drive it until the torque stop
        SKIPN   24
        JUMP    LOOSE
        TOOL    0
        TRAVEL  .2 .3           ;a crossed screw stops high, and so does one in a blocked hole
        SKIPE   8
        JUMP    HOME
        TOOL    -190
        FREE    [1 1 1]         ;back it out, slower than the thread would:
        CHANGE  [0 0 1] .1 .05  ;the thread leads the hand
        TOOL    0
        CHANGE  [0 0 1] .6
        SEARCH  .05             ;where its hole was felt
        SOJG    N K
        WAIT    "SCREW {NR} STOPS HIGH AGAIN AND AGAIN: ITS THREAD IS CROSSED, OR ITS HOLE IS BLOCKED"
        JUMP    HOME
LOOSE:  TOOL    0
        ASSIGN  TAKEN 1         ;it was on the bit; if it stays in its hole, there is none to fetch
        ASSIGN  STAYS 1
        CHANGE  [0 0 1] .6
        SEARCH  .05
        SOJG    N K
        WAIT    "SCREW {NR} MEETS NO TORQUE: ITS POINT, ITS THREAD OR THE BIT IS WRONG"
HOME:   SEAT
        SAVE    H               ;how high its head stands
        CHANGE  [0 0 1] 1
        HERE    H               ;and where: from here it is found again

; The socket down to the head of a driven screw, from where the hand left it.
DEFINE FIND H NR
        MOVE    H
        CHANGE  [0 0 -1] .3     ;still over the hub
        STOP    [0 0 -25]
        FREE    [1 1 0]         ;let the head guide the socket
        CHANGE  [0 0 -1] .8 .4
        SKIPN   23
        WAIT    "SCREW {NR} IS GONE: NO HEAD IS UNDER THE SOCKET, OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"

; A driven screw once more, to the torque stop. On the edge of its head the socket stands .1 in higher than over it, and the
; bit would turn without torque. A screw that is loose by a turn and a half stands .075 in high.
DEFINE TIGHTEN H NR
        ASSIGN  N 2
        ASSIGN  STOOD 1
        SEARCH  .05 STEPS 2
TT:     SKIPN   6               ;high at all places: it is the head that stands high
        JUMP    HIGH
        FIND    H NR
        SEAT
        SKIPN   23              ;the harder push slides the socket off the edge of a head
        JUMP    EDGE
        HEIGHT  H .085 2
        SKIPE   9
        JUMP    EDGE
        HEIGHT  H .05 .085
        SKIPE   9
        JUMP    LOOSE
        HEIGHT  H -.05 .05      ;as high as when it was driven, within a turn of the thread?
        SKIPN   9
        WAIT    "SCREW {NR} IS GONE: NO HEAD IS UNDER THE SOCKET, OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"
        JUMP    DRIVE
EDGE:   CHANGE  [0 0 1] .6
        AOJ     TT
HIGH:   FIND    H NR
LOOSE:  ASSIGN  STOOD 2
DRIVE:  TOOL    190
        TORQUE  42
        FORCE   [0 0 -22]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5
        SKIPE   24
        JUMP    TIGHT
        TOOL    0
        SOJG    N EDGE
        WAIT    "SCREW {NR} DOES NOT HOLD, OR IS GONE: IT MEETS NO TORQUE"
TIGHT:  TOOL    0
        SOJG    STOOD LOW
        JUMP    ON
LOW:    SEAT                    ;one that stood high: it should be down again
        HEIGHT  H -.05 .05
        SKIPN   9
        WAIT    "SCREW {NR} DOES NOT STAND AS IT WAS DRIVEN, OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"
ON:     CHANGE  [0 0 1] 1

; Does it still stand in its place? Closed fingers come down on its end, .2 in away: as high as the arm finds the table.
DEFINE STANDS END
        MOVE    END
        RESTORE TABLE
        RESTORE C1 LEVEL
        RESTORE C2 LEVEL
        OPEN    0               ;only here: they may come from a pin
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .7 .1

; The screwdriver in its rack: its end is 8.1 in over the table, unless it has fallen, or hangs on the guides.
DEFINE RACKED
        STANDS  DEND
        SKIPN   23
        JUMP    FALLEN
        HEIGHT  TABLE 7.96 8.24
        SKIPN   9
FALLEN: WAIT    "THE SCREWDRIVER DOES NOT STAND IN ITS RACK, OR A JOINT READS WRONG"
        CHANGE  [0 0 1] 1

; The screwdriver out of its rack, its place felt both ways: the first time it is as far off as rack and arm may be, the
; second time it stands where it stood.
DEFINE DRIVER MOST
        RACKED
        OPEN    2.2
        MOVE    D
        RESTORE DRV             ;where it was the last time, if it was taken before
        CENTER  .5
        SKIPN   2
        WAIT    "THE SCREWDRIVER DOES NOT STAND IN ITS RACK, OR A JOINT READS WRONG"
        TRAVEL  0 MOST
        SKIPN   8
        WAIT    "THE SCREWDRIVER IS NOT WHERE IT SHOULD BE: ITS RACK HAS MOVED, OR A JOINT READS WRONG"
        SAVE    DRV             ;where the driver really is across the fingers
        OPEN    2
        MOVE    DX
        RESTORE DRV
        RESTORE DRX
        CENTER  .5
        SKIPN   2
        WAIT    "THE SCREWDRIVER DOES NOT STAND IN ITS RACK, OR A JOINT READS WRONG"
        TRAVEL  0 MOST
        SKIPN   8
        WAIT    "THE SCREWDRIVER IS NOT WHERE IT SHOULD BE: ITS RACK HAS MOVED, OR A JOINT READS WRONG"
        SAVE    DRX             ;and the other way
        OPEN    2
        MOVE    D
        RESTORE DRX
        RESTORE DRV
        CLOSE   .9 1.1
        SKIPN   2
        WAIT    "THE SCREWDRIVER DOES NOT STAND IN ITS RACK, OR A JOINT READS WRONG"
        CHANGE  [0 0 1] 2
        LOAD    15
        TOOL    190             ;how fast does it start, and turn? Here nothing resists
        TORQUE  42
        CHANGE  [0 0 1] .2
        SKIPE   24
        WAIT    "THE BIT OF THE SCREWDRIVER DOES NOT TURN FREELY"
        TOOL    0

; The screwdriver down into its rack, as the hand holds it over it.
DEFINE INTO
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the guides guide it
        CHANGE  [0 0 -1] 2.4    ;straight into the rack until it stands
        TRAVEL  2 2.25          ;on the guides it would stand higher

; The screwdriver over its rack.
DEFINE OVER
        MOVE    DUP
        RESTORE DRX
        RESTORE DRV
        SKIPN   4
        WAIT    "THE SCREWDRIVER DOES NOT GO INTO ITS RACK: IT HAS MOVED, OR A JOINT READS WRONG"

; The screwdriver back into its rack: straight, then turned to either side, then beside that place. The guides centre it, but
; cannot turn it: its block has play for 2.3 degrees, and rack and hand may be turned more against each other.
DEFINE RACK
        OVER
        INTO
        SKIPE   8
        JUMP    STANDS
        OVER
        TURN    DUP 1.5
        INTO
        SKIPE   8
        JUMP    STANDS
        OVER
        TURN    DUP -1.5
        INTO
        SKIPE   8
        JUMP    STANDS
        SEARCH  .07
PUT:    SKIPN   6
        WAIT    "THE SCREWDRIVER DOES NOT GO INTO ITS RACK: IT HAS MOVED, OR A JOINT READS WRONG"
        OVER
        INTO
        SKIPN   8
        AOJ     PUT
STANDS: LOAD    0
        OPEN    1.6
        CHANGE  [0 0 1] 2

; A pin back into its holder.
DEFINE UNPIN Q P NR
        OPEN    .8
        MOVE    Q
        RESTORE Y1
        RESTORE X2
        RESTORE HS LEVEL        ;how far the base has moved since, by the hole of the last screw
        SKIPN   4
        WAIT    "PIN {NR} IS NOT WHERE IT WAS PUT: IT OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"
        CENTER  .1              ;that tells it to the play of the screwdriver in the hand
        SKIPE   2
        JUMP    PIN
        WAIT    "PIN {NR} IS NOT WHERE IT WAS PUT: IT OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"
PIN:    CLOSE   .1
        CHANGE  [0 0 1] 2
        SKIPN   4
        WAIT    "PIN {NR} DOES NOT COME OUT OF ITS HOLE, OR A JOINT READS WRONG"
        SEARCH  .05
R:      SKIPN   6
        WAIT    "PIN {NR} DOES NOT GO INTO ITS HOLDER: IT HAS MOVED, OR A JOINT READS WRONG"
        MOVE    P
        RESTORE C1 LEVEL        ;one pin has told where the holder is along y,
        RESTORE C2 LEVEL        ;and the other along x
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the hole guide the pin
        CHANGE  [0 0 -1] 1.2
        TRAVEL  .7 1.1          ;home, or on top of the holder?
        SKIPN   8
        AOJ     R
        OPEN    1

; The gasket that is held, down to the pins, and over them if its holes are there.
DEFINE LOWER
        STOP    [0 0 -24]
        CHANGE  [0 0 -1] 2.3
        SKIPN   23
        WAIT    "THE GASKET MEETS NOTHING: IT LIES REVERSED, OR IS LOST"
        TRAVEL  1.2 2.2         ;a gasket that stands on the pins stops high

; The gasket that is held, onto the pins. Fingers that close on its web know where it is along x; along y it is searched for
; about where the arm takes it, which is as far off as it was where the gasket lay. The first pin is no better guide: it tells
; how far the arm and the blocks are off together, and the stand is not off with the blocks.
DEFINE LAY
        SEARCH  .05 ALONG 90 STEPS 3
LG:     SKIPN   6               ;all places tried
        JUMP    LEFT
        MOVE    GON
        RESTORE GRIP            ;higher, if it is held by the very tips
        RESTORE X2
        LOWER
        SKIPE   8
        JUMP    ON
        AOJ     LG
LEFT:   SEARCH  .05 ALONG 90    ;it may have lain askew, and so the fingers hold it: two degrees to the left
LL:     SKIPN   6
        JUMP    RIGHT
        MOVE    GON
        RESTORE GRIP
        RESTORE X2
        TURN    GON 2
        LOWER
        SKIPE   8
        JUMP    ON
        AOJ     LL
RIGHT:  SEARCH  .05 ALONG 90    ;and to the right
LR:     SKIPN   6
        JUMP    STRAIGHT
        MOVE    GON
        RESTORE GRIP
        RESTORE X2
        TURN    GON -2
        LOWER
        SKIPE   8
        JUMP    ON
        AOJ     LR
STRAIGHT: SEARCH .05 ALONG 90   ;.2 in to either side: pressed on the pins, it has straightened between the fingers
LN:     SKIPN   6
        JUMP    WIDER
        MOVE    GON
        RESTORE GRIP
        RESTORE X2
        LOWER
        SKIPE   8
        JUMP    ON
        AOJ     LN
WIDER:  SEARCH  .05
LF:     SKIPN   6
        WAIT    "THE GASKET DOES NOT GO DOWN ON ITS PINS: IT IS HELD ASKEW, OR A JOINT READS WRONG"
        MOVE    GON
        RESTORE GRIP
        RESTORE X2
        RESTORE Y1
        LOWER
        SKIPN   8
        AOJ     LF
ON:     OPEN    1.9
        CHANGE  [0 0 1] 1

; The gasket that lies on the base, taken up again: by its lower half, .03 in over the face as it was felt. In the holes of the
; base, the fingers would take hold of the base.
DEFINE LIFT
        OPEN    1.9
        MOVE    GOFF
        RESTORE X2
        RESTORE BARE            ;to 1.75 in over the face
        STOP    [0 0 -24]
        CHANGE  [0 0 -1] 2
        SKIPE   23              ;no resistance: a finger is in each large hole
        WAIT    "THE GASKET CANNOT BE TAKEN UP AGAIN"
        CHANGE  [0 0 1] .28
        CLOSE   .7
        SKIPN   2
        WAIT    "THE GASKET CANNOT BE TAKEN UP AGAIN"
        CHANGE  [0 0 1] 2
        SKIPN   4
        WAIT    "THE GASKET CANNOT BE TAKEN UP AGAIN: IT DOES NOT COME OFF, OR A JOINT READS WRONG"
        SAVE    GRIP            ;how much higher the hand holds it

; Down to the flange of the top on its stand, a finger on each side of its hub.
DEFINE BESTRIDE
        MOVE    TOPUP
        SKIPN   4               ;the hand has met the top
        WAIT    "THE TOP IS NOT WHERE IT SHOULD BE: IT OR ITS STAND HAS MOVED, OR A JOINT READS WRONG"
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .8 .5
        SKIPN   23
        WAIT    "NO TOP IS ON ITS STAND, OR THE STAND HAS MOVED"
        CHANGE  [0 0 1] .15

; The top that is held, onto the pins: likewise. CENTER knows where it is along y.
DEFINE COVER
        SEARCH  .05 ALONG 0 STEPS 3
LT:     SKIPN   6               ;all places tried
        JUMP    NEARER
        MOVE    TOPON
        RESTORE Y1
        STOP    [0 0 -43]
        CHANGE  [0 0 -1] 2.3
        SKIPN   23
        WAIT    "THE TOP MEETS NOTHING: IT IS LOST"
        TRAVEL  1.2 2.1         ;a top that stands on the pins stops high
        SKIPE   8
        JUMP    ON
        ASSIGN  STOOD 2         ;skew on the pins, it may take them along
        AOJ     LT
NEARER: SEARCH  .05 ALONG 0
LX:     SKIPN   6
        JUMP    LEFT
        MOVE    TOPON
        RESTORE Y1
        RESTORE X2
        STOP    [0 0 -43]
        CHANGE  [0 0 -1] 2.3
        TRAVEL  1.2 2.1
        SKIPE   8
        JUMP    ON
        AOJ     LX
LEFT:   SEARCH  .05 ALONG 0     ;base and hand may be turned against each other
LY:     SKIPN   6
        JUMP    RIGHT
        MOVE    TOPON
        RESTORE Y1
        TURN    TOPON 1.5
        STOP    [0 0 -43]
        CHANGE  [0 0 -1] 2.3
        TRAVEL  1.2 2.1
        SKIPE   8
        JUMP    ON
        AOJ     LY
RIGHT:  SEARCH  .05 ALONG 0
LZ:     SKIPN   6
        JUMP    WIDER
        MOVE    TOPON
        RESTORE Y1
        TURN    TOPON -1.5
        STOP    [0 0 -43]
        CHANGE  [0 0 -1] 2.3
        TRAVEL  1.2 2.1
        SKIPE   8
        JUMP    ON
        AOJ     LZ
WIDER:  SEARCH  .05
LU:     SKIPN   6
        WAIT    "THE TOP DOES NOT GO DOWN ON ITS PINS: IT IS HELD ASKEW, OR A JOINT READS WRONG"
        MOVE    TOPON
        RESTORE E1 LEVEL
        STOP    [0 0 -43]
        CHANGE  [0 0 -1] 2.3
        SKIPN   23
        WAIT    "THE TOP MEETS NOTHING: IT IS LOST"
        TRAVEL  1.2 2.1
        SKIPN   8
        AOJ     LU
ON:     LOAD    0
        OPEN    2.8
        CHANGE  [0 0 1] 3

; The top that lies on the gasket, taken up again.
DEFINE UNCOVER
        OPEN    2.8
        MOVE    TOPON
        RESTORE Y1
        STOP    [0 0 -43]
        CHANGE  [0 0 -1] 1.95
        SKIPE   23
        CHANGE  [0 0 1] .05     ;off the flange
        CLOSE   2 2.4
        SKIPN   2
        WAIT    "THE TOP DOES NOT LIE FLAT ON THE GASKET, OR THE GASKET IS MISSING"
        LOAD    36
        CHANGE  [0 0 1] 2.3
        SKIPN   4               ;a pin holds it
        WAIT    "THE TOP DOES NOT COME OFF ITS PINS, OR A JOINT READS WRONG"

; How high is what lies there? Closed fingers go down to it, slowly: .002 in a servo period.
DEFINE FEEL SPOT
        OPEN    0
        MOVE    SPOT
        RESTORE Y1
        RESTORE X2
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .7 .1

; How high is the face of the base there? It is 1.75 in over the table: closed fingers begin .1 in over it. The arm reaches as
; far to the place BESIDE the base where it has felt the table, and so is off in height by nearly as much.
DEFINE PRESS SPOT BESIDE UNEVEN
        MOVE    SPOT
        RESTORE BESIDE
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .4 .1
        HEIGHT  BESIDE 1.714 1.786
        SKIPN   9
        JUMP    UNEVEN

; Does the base lie flat? LAYERS compares with the heights that are saved here. A second round feels everything .06 in farther
; out, half a converter step of the shoulder: in the same places, the arm would misread its height by as much again.
DEFINE FLATNESS
        ASSIGN  TRIES 2
        SEARCH  .06 ALONG 90 STEPS 1
        OPEN    0
LEAN:   MOVE    TABLEL
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .7 .1
        SAVE    TABLEL          ;how high the arm finds the table on one side of the base
        CHANGE  [0 0 1] 3       ;over the base
        MOVE    TABLE
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .7 .1
        SAVE    TABLE
        HEIGHT  TABLEL -.036 .036 ;as high on the other side, or does something lie there, and under the base?
        SKIPE   9
        JUMP    FACES
UNEVEN: CHANGE  [0 0 1] 1
        SOJG    TRIES OUT
        WAIT    "THE BASE DOES NOT LIE FLAT: SOMETHING LIES UNDER IT OR BESIDE IT, OR A JOINT READS WRONG"
        JUMP    EVEN
OUT:    AOJ     LEAN            ;RESTORE takes the face along
FACES:  PRESS   FACE1 TABLEL UNEVEN
        SAVE    FACE1
        PRESS   FACE4 TABLEL UNEVEN
        HEIGHT  FACE1 -.018 .018 ;.26 degrees along this side
        SKIPN   9
        JUMP    UNEVEN
        SAVE    FACE4
        PRESS   FACE5 TABLE UNEVEN
        SAVE    FACE5
        PRESS   FACE2 TABLE UNEVEN
        HEIGHT  FACE5 -.018 .018
        SKIPN   9
        JUMP    UNEVEN
        SAVE    FACE2
EVEN:   CHANGE  [0 0 1] 1

; Does a head stand as high over the face as the parts are thick? If it does not, it is felt once more, .06 in farther out: see
; FLATNESS.
DEFINE HEAD SPOT OVER NR
        SEARCH  .06 ALONG 90 STEPS 1
T:      MOVE    SPOT
        RESTORE Y1
        RESTORE X2
        RESTORE BARE            ;to .1 in over it
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .4 .1
        HEIGHT  OVER .493 .529
        SKIPE   9
        JUMP    RIGHT
        SOJG    AGAIN OUT
        HEIGHT  OVER .511 2
        SKIPE   9
        JUMP    HIGH
        WAIT    "SCREW {NR} IS GONE: NO HEAD IS UNDER THE FINGERS, OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"
        JUMP    RIGHT
OUT:    AOJ     T
HIGH:   WAIT    "SCREW {NR} STANDS HIGH: IT IS LOOSE, OR SOMETHING LIES UNDER THE TOP, OR A JOINT READS WRONG"
RIGHT:  ASSIGN  AGAIN 2         ;for the next

; Does the pump still stand where it was put? Closed fingers come to its rim, .3 in away, and push it to its block. Their
; height is that of the face as it was felt: a sixth of an inch lower, the palm would stand on the crank.
DEFINE NUDGE SPOT PUSH WAY
        MOVE    SPOT
        RESTORE Y1
        RESTORE X2
        RESTORE BARE
        STOP    PUSH
        CHANGE  WAY .8 .2
        SKIPN   23
        WAIT    "THE PUMP IS NOT WHERE IT WAS PUT: NOTHING STANDS THERE, OR A JOINT READS WRONG"
        TRAVEL  .2 .4
        SKIPN   8
        WAIT    "THE PUMP IS NOT WHERE IT WAS PUT: IT HAS MOVED, OR A JOINT READS WRONG"

; A pin in its holder: its end is 3.51 in over the table, unless it stands on something.
DEFINE PLUGGED END NR
        STANDS  END
        SKIPN   23
        JUMP    OUT
        HEIGHT  TABLE 3.41 3.61
        SKIPN   9
OUT:    WAIT    "PIN {NR} DOES NOT STAND IN ITS HOLDER, OR A JOINT READS WRONG"
        CHANGE  [0 0 1] 1

; The rotor one way by an open fork, which pushes and does not pinch. The fork is centred first, and then stands free while
; the guard takes its zero: one that leaned on the crank would feel the rotor twice.
DEFINE SWEEP ANGLE
        CENTER  .3
        SKIPN   2
        WAIT    "THE CRANK IS NOT WHERE IT WAS LEFT"
        OPEN    .5
        STOP    15
        TURN    AXIS ANGLE
        SKIPE   23              ;it should meet no such resistance
        WAIT    "THE ROTOR IS HARD TO TURN, OR A JOINT OF THE ARM IS"
        OPEN    .9

; So far to one side, and back, about the axis where the hand has it: on a circle beside it the crank would slide
; along the fingers, and rub.
DEFINE SWING GRIP OUT BACK
        OPEN    .9
        MOVE    ROTOR
        RESTORE Y1
        RESTORE X2
        HERE    AXIS
        MOVE    GRIP
        RESTORE Y1
        RESTORE X2
        SWEEP   OUT
        SWEEP   BACK
        CHANGE  [0 0 1] 1.5     ;off the crank, before the fingers shut

; Does the rotor sit in its bearing? Closed fingers come down on the end of its crank pin, where the last turn has left it.
DEFINE BEARING
        OPEN    0
        MOVE    CRANKEND
        RESTORE Y1
        RESTORE X2
        RESTORE BARE            ;to .2 in over it
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .6 .1
        SKIPN   23
        JUMP    OFF
        HEIGHT  BARE 2.8 2.92
        SKIPN   9
OFF:    WAIT    "THE ROTOR DOES NOT SIT IN ITS BEARING, OR ITS CRANK IS BENT, OR A JOINT READS WRONG"
        CHANGE  [0 0 1] 1.5

; What the last stage looks at. The rotor, over its whole turn and both ways: the hand cannot go all the way round.
DEFINE ROTATION
        SWING   CRANK 190 -190
        SWING   CRANKB -190 190
        BEARING

; The heads, one after the other around the pump: so the driver never goes over the crank.
DEFINE HEADS
        DRIVER  .1
        TIGHTEN H1 4
        TIGHTEN H0 1
        TIGHTEN H4 5
        TIGHTEN H5 3
        TIGHTEN H3 6
        TIGHTEN H2 2
        RACK

; Screwdriver and pins in their places.
DEFINE TOOLS
        RACKED
        PLUGGED P1END 1
        PLUGGED P2END 2

; What lies over the face of the base at each screw: gasket, flange and head, .511 in under six screws. As late as can be: no picture
; tells whether a screw is loose.
DEFINE LAYERS
        OPEN    0
        ASSIGN  AGAIN 2
        HEAD    HEAD1 FACE1 4
        HEAD    HEAD0 FACE4 1
        HEAD    HEAD4 FACE4 5
        HEAD    HEAD5 FACE5 3
        HEAD    HEAD3 FACE2 6
        HEAD    HEAD2 FACE2 2
        CHANGE  [0 0 1] 1

; The pump against its blocks, as hard as the base was put there.
DEFINE BLOCKS
        OPEN    0
        NUDGE   RIM1 [0 72 0] [0 1 0] ;the driver turns it: one corner is there first, and 50 oz do not turn it back
        CHANGE  [0 0 1] 1
        NUDGE   RIM2 [-72 0 0] [-1 0 0]
        CHANGE  [0 0 1] 1

        STAGE   "find the base"
        LENS    25              ;the camera's mechanism is slow: meanwhile the arm
        AIM     BASE
        PARK                    ;goes out of its sight
        ASSIGN  SECOND 2
        ASSIGN  THIRD 2
WIDE:   LOOK    WIDE
        GENERAL BASE WIDE
        SKIPE   30
        JUMP    NEAR
        ELSEWHERE WIDE NEAR OUTLINE
NEAR:   LENS    50
        AIM     BASE
        ASSIGN  SECOND 2
        ASSIGN  THIRD 2
CLOSER: LOOK    CLOSE_UP
        SPECIFIC BASE CLOSE_UP
        SKIPE   31
        JUMP    SEEN
        ELSEWHERE CLOSER SEEN HOLES
SEEN:   LOAD    0               ;nothing is in the hand

        STAGE   "feel for the grasp"
        ASSIGN  TRIES 3
        OPEN    0               ;shut, they must read nothing
GRASP:  OPEN    1.775
        SEARCH  .2
LA:     SKIPN   6               ;all places tried
        JUMP    MISSED
        MOVE    A
        SKIPN   4               ;the base is where it should not be
        JUMP    MISSED
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] 1.5    ;one finger into the large hole
        SKIPE   23              ;no resistance: neither finger stands on the casting
        AOJ     LA
        CENTER  .5
        SKIPN   2
        JUMP    MISSED
        SAVE    DA              ;how far it is off across this wall
        OPEN    1.42
        ASSIGN  FAR 1
        SEARCH  .2
LB:     SKIPN   6
        JUMP    MISSED
        MOVE    B
        RESTORE DA
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] 1.5    ;one finger into the small hole
        SKIPN   23
        JUMP    WALL
        ASSIGN  FAR 2
        AOJ     LB
WALL:   CENTER  .3
        SKIPN   2
        JUMP    MISSED
        SAVE    DB              ;and along the line of centres
        SOJG    FAR ACROSS
        JUMP    FELT
ACROSS: OPEN    1.775           ;far off: the first wall was felt where it bends. Once more, in its middle
        MOVE    A
        RESTORE DB
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] 1.5
        SKIPE   23
        JUMP    FELT
        CENTER  .5
        SKIPN   2
        JUMP    MISSED
        SAVE    DA
FELT:   OPEN    1.85
        MOVE    WEB
        RESTORE DA
        RESTORE DB
        CLOSE   .9 1.4
        SKIPN   2
        JUMP    MISSED
        SKIPE   7
        JUMP    HELD
MISSED: OPEN    1.775
        SOJG    TRIES AFRESH
GONE:   WAIT    "THE BASE IS NOT WHERE IT WAS SEEN: IT OR THE CAMERA HAS MOVED, OR A JOINT READS WRONG"
AFRESH: PARK                    ;look again: it may have been moved
        LOOK    CLOSE_UP
        SPECIFIC BASE CLOSE_UP
        SKIPN   31
        JUMP    GONE
        JUMP    GRASP
HELD:   LOAD    84.6

        STAGE   "put the base in its standard position"
        CHANGE  [0 0 1] 1
        MOVE    S0
        STOP    [0 0 -29]
        CHANGE  [0 0 -1] 1.2 .5 ;set it down
        SKIPN   23
        WAIT    "NO TABLE: THE BASE IS LOST, OR A JOINT READS WRONG"
        LOAD    0
        STOP    [0 72 0]
        CHANGE  [0 1 0] 1.2 .5  ;against the far block
        SKIPN   23
        WAIT    "NO FAR BLOCK: THE BASE IS LOST, OR A JOINT READS WRONG"
        STOP    [-72 0 0]
        CHANGE  [-1 0 0] 1.2 .5 ;against the left block
        SKIPN   23
        WAIT    "NO LEFT BLOCK: THE BASE IS LOST, OR A JOINT READS WRONG"
        STOP    [0 72 0]
        CHANGE  [0 1 0] 1.2 .5  ;and once more, where that has dragged it off
        OPEN    1.85
        CHANGE  [0 0 1] 2
        AIM     PUMP            ;for the gasket: meanwhile its face is felt, and the pins go in
        FLATNESS

        STAGE   "insert the aligning pins"
        OPEN    1.3
        MOVE    P1
        CENTER  .1
        SKIPN   2
        WAIT    "PIN 1 IS NOT IN ITS HOLDER: IT IS MISSING, OR THE HOLDER HAS MOVED, OR A JOINT READS WRONG"
        TRAVEL  0 .35           ;as far as arm and holder are off together at twice their errors
        SKIPN   8
        WAIT    "THE HOLDER OF PIN 1 IS NOT WHERE IT SHOULD BE: IT HAS MOVED, OR A JOINT READS WRONG"
        CLOSE   0.1             ;grasp it
        SAVE    C1              ;where the holder really is: a pin leans in it until the fingers grasp it
        CHANGE  [0 0 1] 1.5     ;draw it out of its holder
        CLOSE   0.1             ;has it come along?
        MOVE    T1              ;GO TO THE HOLE
        SEARCH  .07 STEPS 4     ;as far as arm, holder and hand may be off together
L1:     SKIPN   6               ;all places tried
        JUMP    NONE1
        MOVE    T1              ;GO TO THE HOLE
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 0.6    ;TRY TO GO DOWN WITHOUT MEETING RESISTANCE
        SKIPE   23              ;no resistance: the pin is in a hole
        AOJ     L1
        STOP    [0 0 -60]
        CHANGE  [0 0 -1] 0.6    ;IT SHOULD MEET SOME RESISTANCE
        SKIPN   23
        AOJ     L1              ;none: that was no hole
        SAVE    E1
        OPEN    .5
        CLOSE   0.1             ;AND CHECK THAT IT IS STILL THERE
        STOP    [0 36 0]
        CHANGE  [0 1 0] .3 .5   ;a push: its hole leaves it .02 in of play, the large hole 2 in
        SKIPN   23
        AOJ     L1              ;it does: that was no screw hole
        JUMP    IN1
NONE1:  MOVE    T1              ;is there anything to stand on?
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 1
        SKIPE   23
        JUMP    FULL1
        WAIT    "NO BASE STANDS UNDER PIN 1, OR IT MOVES WITH THE PIN"
        JUMP    IN1
FULL1:  WAIT    "PIN 1 FINDS NO HOLE: ITS NOSE OR THE HOLE IS WRONG, OR THE BASE HAS MOVED, OR A JOINT READS WRONG"
IN1:    OPEN    .5
        CENTER  .1
        SAVE    Y1              ;where its hole is, across the line of centres
        OPEN    1.3
        MOVE    P2
        RESTORE C1 LEVEL        ;so that it stands in the middle of the fingers the other way, too
        CENTER  .1
        SKIPN   2
        WAIT    "PIN 2 IS NOT IN ITS HOLDER: IT IS MISSING, OR THE HOLDER HAS MOVED, OR A JOINT READS WRONG"
        TRAVEL  0 .35
        SKIPN   8
        WAIT    "THE HOLDER OF PIN 2 IS NOT WHERE IT SHOULD BE: IT HAS MOVED, OR A JOINT READS WRONG"
        CLOSE   0.1             ;grasp it
        SAVE    C2              ;where the holder really is
        CHANGE  [0 0 1] 1.5     ;draw it out of its holder
        CLOSE   0.1             ;has it come along?
        MOVE    T2              ;GO TO THE HOLE
        RESTORE E1 LEVEL        ;as far off as the first hole; but that pin stood beside the middle of the fingers,
        RESTORE C2 LEVEL        ;by as much as the arm missed the holder
        SEARCH  .07 STEPS 4
L2:     SKIPN   6               ;all places tried
        JUMP    NONE2
        MOVE    T2              ;GO TO THE HOLE
        RESTORE E1 LEVEL
        RESTORE C2 LEVEL
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 0.6    ;TRY TO GO DOWN WITHOUT MEETING RESISTANCE
        SKIPE   23              ;no resistance: the pin is in a hole
        AOJ     L2
        STOP    [0 0 -60]
        CHANGE  [0 0 -1] 0.6    ;IT SHOULD MEET SOME RESISTANCE
        SKIPN   23
        AOJ     L2              ;none: that was no hole
        OPEN    .5
        CLOSE   0.1             ;AND CHECK THAT IT IS STILL THERE
        STOP    [-36 0 0]
        CHANGE  [-1 0 0] .3 .5  ;it should resist a push, too
        SKIPN   23
        AOJ     L2              ;it does: that was no screw hole
        JUMP    IN2
NONE2:  MOVE    T2
        RESTORE E1 LEVEL
        RESTORE C2 LEVEL
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 1
        SKIPE   23
        JUMP    FULL2
        WAIT    "NO BASE STANDS UNDER PIN 2, OR IT MOVES WITH THE PIN"
        JUMP    IN2
FULL2:  WAIT    "PIN 2 FINDS NO HOLE: ITS NOSE OR THE HOLE IS WRONG, OR THE BASE HAS MOVED, OR A JOINT READS WRONG"
IN2:    OPEN    1.2
        MOVE    Q2              ;unshifted along x, for SAVE measures from here
        RESTORE Y1
        CENTER  .1
        SAVE    X2              ;where its hole is, along the line of centres
        OPEN    1.2
        MOVE    Q2Y
        RESTORE X2
        CENTER  .1
        SAVE    Y2              ;and across it: the base may be turned
        OPEN    1
        MOVE    FACE            ;over the web of the base
        RESTORE Y1
        RESTORE X2
        OPEN    0
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .7 .1  ;slowly: .002 in a servo period
        SAVE    BARE            ;how high its face is
        CHANGE  [0 0 1] 1

        STAGE   "put on the gasket"
        PARK
        LOOK    BEFORE          ;the camera was aimed while the pins went in
        OPEN    1.9
        SEARCH  .1 ALONG 0 STEPS 1
GX:     SKIPN   6               ;all places tried
        JUMP    AROUND
        MOVE    GUP
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .75
        SKIPN   23
        JUMP    INSIDE          ;no resistance: a finger is in each large hole
        AOJ     GX
AROUND: ASSIGN  TRIES 9         ;aside, too: so it is held aside, and is laid so
        SEARCH  .1
GA:     MOVE    GUP
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .75
        SKIPN   23
        JUMP    INSIDE
        SOJG    TRIES BESIDE
        WAIT    "THE GASKET IS NOT WHERE IT SHOULD BE: ITS HOLES ARE NOT FELT, OR A JOINT READS WRONG"
BESIDE: AOJ     GA
INSIDE: CLOSE   .7
        SKIPN   2
        WAIT    "THE GASKET IS NOT WHERE IT SHOULD BE: NONE IS BETWEEN THE FINGERS, OR A JOINT READS WRONG"
        CHANGE  [0 0 1] 1
        SKIPN   4               ;it is caught on its stand
        WAIT    "THE GASKET IS NOT WHERE IT SHOULD BE: IT DOES NOT COME UP, OR A JOINT READS WRONG"
        ASSIGN  TRIES 2
LAYING: LAY
        MOVE    FACE
        RESTORE Y1
        RESTORE X2
        OPEN    0
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .7 .1
        HEIGHT  BARE .04 .08    ;one gasket, .06 in thick
        SKIPE   9
        JUMP    FLAT
        HEIGHT  BARE .08 1      ;higher: it is caught on something; lower: there is none to take up
        SKIPE   9
        JUMP    THICK
        WAIT    "THE GASKET IS MISSING OR TOO THIN, OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"
        JUMP    FLAT
THICK:  SOJG    TRIES AGAIN
        WAIT    "THE GASKET LIES TOO HIGH: THERE ARE TWO, OR IT IS TOO THICK, OR SOMETHING LIES UNDER IT"
        JUMP    FLAT
AGAIN:  CHANGE  [0 0 1] 1
        LIFT
        JUMP    LAYING
FLAT:   SAVE    LAID            ;how high it lies
        CHANGE  [0 0 1] 1

        STAGE   "check the gasket"
        ASSIGN  TRIES 2
        PARK
CHECK:  ASSIGN  LOOKS 2
LOOKS:  LOOK    AFTER HOLD
        INSPECT PUMP BEFORE AFTER
        SKIPE   32
        JUMP    RIGHT
        SOJG    LOOKS LOOKS
        SOJG    TRIES ANEW
        WAIT    "THE GASKET IS NOT ON PROPERLY, OR THE CAMERA OR THE LIGHT HAS CHANGED"
        JUMP    RIGHT
ANEW:   FEEL    FACE            ;both pictures again, the arm elsewhere: its shadow may have lain on the pump
        HEIGHT  BARE .04 1
        SKIPN   9
        WAIT    "THE GASKET IS MISSING OR TOO THIN, OR THE PUMP HAS MOVED, OR A JOINT READS WRONG"
        CHANGE  [0 0 1] 1
        LIFT
        MOVE    ASIDE
        LOOK    BEFORE
        LAY
        MOVE    ASIDE
        JUMP    CHECK
RIGHT:  OPEN    3.4             ;for the top: .6 in beside its hub on each side

        STAGE   "put on the top"
        BESTRIDE
        CLOSE   2               ;its hub into the line of the hand, and its narrow end: so the top is turned straight.
        SKIPN   2
        WAIT    "NO TOP IS ON ITS STAND, OR THE STAND HAS MOVED"
        OPEN    3.4             ;fingers that close on the hub alone wedge it as it lies
        MOVE    TOPEND
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] 1 .5   ;beside it, down to the stand
        SKIPN   23
        WAIT    "NO STAND IS UNDER THE TOP"
        CHANGE  [0 0 1] .1
        CLOSE   1.5
        SKIPN   2
        WAIT    "NO TOP UNDER THE FINGERS: IT IS REVERSED OR LOST, OR ITS STAND HAS MOVED"
        OPEN    3.4
        BESTRIDE
        CENTER  2
        SKIPN   2
        WAIT    "NO TOP IS ON ITS STAND, OR THE STAND HAS MOVED"
        CLOSE   2 2.4
        SKIPN   2
        WAIT    "NO TOP IS ON ITS STAND, OR THE STAND HAS MOVED"
        LOAD    36
        CHANGE  [0 0 1] 1
        ASSIGN  TRIES 2
        ASSIGN  STOOD 1
TOPPING: COVER
        OPEN    0               ;before it goes down beside the pin
        MOVE    FLANGE          ;over its narrow end
        RESTORE Y1
        RESTORE X2
        SKIPE   4               ;the hand has met it: it stands askew on its pins
        SKIPN   52
        JUMP    ASKEW
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .6 .1
        SKIPN   52
        JUMP    ASKEW
        SKIPN   23
        WAIT    "NO TOP UNDER THE FINGERS: IT IS REVERSED OR LOST, OR ITS STAND HAS MOVED"
        HEIGHT  LAID .27 .33    ;its flange is .3 in thick: nothing is under it
        SKIPE   9
        JUMP    COVERED
ASKEW:  CHANGE  [0 0 1] 2       ;above the pins, before the hand opens
        SOJG    TRIES OFF
        WAIT    "THE TOP DOES NOT LIE FLAT ON THE GASKET, OR THE GASKET IS MISSING"
        JUMP    COVERED
OFF:    UNCOVER
        ASSIGN  STOOD 2
        JUMP    TOPPING
COVERED: CHANGE [0 0 1] 2       ;above the pins, before the hand opens
        SOJG    STOOD PINS
        JUMP    TOPPED
PINS:   FEEL    T1END           ;do both still stand?
        SKIPN   23
        WAIT    "PIN 1 DOES NOT STAND: THE TOP HAS DRAWN IT OUT"
        FEEL    T2END
        SKIPN   23
        WAIT    "PIN 2 DOES NOT STAND: THE TOP HAS DRAWN IT OUT"
        CHANGE  [0 0 1] 1
TOPPED: OPEN    2.2             ;for the screwdriver

        STAGE   "drive the first two screws"
        DRIVER  .35
        SCREW   S1 H0 Y1 1
        SCREW   S2 H2 Y1 2
        RACK

        STAGE   "take out the aligning pins"
        UNPIN   Q1 P1UP 1
        UNPIN   Q2 P2UP 2

        STAGE   "drive the last four screws"
        DRIVER  .1
        SCREW   S3 H5 Y2 3
        SCREW   S4 H1 Y1 4
        SCREW   S5 H4 Y2 5
        SCREW   S6 H3 Y1 6
        RACK

        STAGE   "turn the rotor"
        SWING   CRANK 60 -60

        STAGE   "inspect the pump"
        ASSIGN  TRIES 2
        JUMP    ALL
MOVED:  SOJG    TRIES ALL       ;by the inspection itself? All of it once more
        WAIT    "THE PUMP IS NOT WHERE IT WAS PUT: IT HAS MOVED SINCE IT WAS FELT, OR THE CAMERA OR THE LIGHT HAS CHANGED"
ALL:    BLOCKS                  ;home, before it is felt
        HEADS
        BLOCKS                  ;the driver has drawn it off a little
        ROTATION                ;driven again, the screws may have made the rotor bind
        OPEN    0               ;as in the last picture: the shadow of the hand may lie on the pump
        MOVE    BACK            ;from PARK, the arm would shade a head in one world of 19
        LOOK    WHOLE           ;what is lost from here on, the last picture shows
        BLOCKS                  ;home, if it was moved before the picture: then the next one differs
        LAYERS
        TOOLS                   ;no camera sees them
        MOVE    BACK
        LOOK    DONE HOLD
        MATCH   PUMP WHOLE DONE ;does it still stand as it was felt?
        SKIPN   33
        JUMP    MOVED
        PARK
