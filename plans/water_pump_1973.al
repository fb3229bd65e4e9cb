; The water pump of 1973, assembled in eleven steps as the paper tells them: it searches for what is not quite in its place,
; and whatever else goes wrong calls the operator. water_pump.al is the careful one, which tries again.
;
; The comments in capitals, and the instructions beside them, stand in the listing of 1973.
; Inches, ounces, degrees. Positions are taught, in the file beside this one.

        STAGE   "find the base"
        LENS    25              ;the camera's mechanism is slow: meanwhile the arm
        AIM     BASE
        PARK                    ;goes out of its sight
        LOOK    WIDE
        GENERAL BASE WIDE
        LENS    50
        AIM     BASE
        LOOK    CLOSE_UP
        SPECIFIC BASE CLOSE_UP

        STAGE   "feel for the grasp"
        OPEN    0               ;shut, they must read nothing
        OPEN    1.775
        SEARCH  .2
LA:     MOVE    A
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] 1.5    ;one finger into the large hole
        SKIPE   23              ;no resistance: neither finger stands on the casting
        AOJ     LA
        CENTER  .5
        SAVE    DA              ;how far it is off across this wall
        OPEN    1.42
        SEARCH  .2
LB:     MOVE    B
        RESTORE DA
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] 1.5    ;one finger into the small hole
        SKIPE   23
        AOJ     LB
        CENTER  .3
        SAVE    DB              ;and along the line of centres
        OPEN    1.85
        MOVE    WEB
        RESTORE DA
        RESTORE DB
        CLOSE   .9 1.4

        STAGE   "put the base in its standard position"
        LOAD    84.6
        CHANGE  [0 0 1] 1
        MOVE    S0
        STOP    [0 0 -29]
        CHANGE  [0 0 -1] 1.2 .5 ;set it down
        SKIPN   23
        WAIT    "NO TABLE UNDER THE BASE: IT IS LOST, OR A JOINT READS WRONG"
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
        AIM     PUMP            ;for the gasket: meanwhile the pins go in

        STAGE   "insert the aligning pins"
        OPEN    1
        MOVE    P1
        CENTER  .1
        SAVE    C1              ;where the holder really is
        CLOSE   0.1             ;grasp it
        CHANGE  [0 0 1] 1.5     ;draw it out of its holder
        MOVE    T1              ;GO TO THE HOLE
        SEARCH  .07
L1:     MOVE    T1              ;GO TO THE HOLE
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
        OPEN    .5
        CENTER  .1
        SAVE    Y1              ;where its hole is, across the line of centres
        OPEN    1
        MOVE    P2
        CENTER  .1
        SAVE    C2              ;where the holder really is
        CLOSE   0.1             ;grasp it
        CHANGE  [0 0 1] 1.5     ;draw it out of its holder
        MOVE    T2              ;GO TO THE HOLE
        SEARCH  .07
L2:     MOVE    T2              ;GO TO THE HOLE
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] 0.6    ;TRY TO GO DOWN WITHOUT MEETING RESISTANCE
        SKIPE   23              ;no resistance: the pin is in a hole
        AOJ     L2
        STOP    [0 0 -60]
        CHANGE  [0 0 -1] 0.6    ;IT SHOULD MEET SOME RESISTANCE
        SKIPN   23
        AOJ     L2              ;none: that was no hole
        SAVE    E2
        OPEN    .5
        CLOSE   0.1             ;AND CHECK THAT IT IS STILL THERE
        STOP    [-36 0 0]
        CHANGE  [-1 0 0] .3 .5  ;it should resist a push, too
        OPEN    .5
        CENTER  .1
        SAVE    X2              ;where its hole is, along the line of centres
        OPEN    1
        MOVE    FACE            ;over the web of the base
        OPEN    0
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .6 .1  ;slowly: .002 in a servo period
        SAVE    BARE            ;how high its face is
        CHANGE  [0 0 1] 1

        STAGE   "put on the gasket"
        PARK
        LOOK    BEFORE          ;the camera was aimed while the pins went in
        OPEN    1.9
        MOVE    GUP
        STOP    [0 0 -25]
        CHANGE  [0 0 -1] .7
        SKIPE   23              ;no resistance: a finger is in each large hole
        WAIT    "THE GASKET LIES OFF ITS PLACE"
        MOVE    G DIRECT
        CLOSE   .7
        CHANGE  [0 0 1] 1
        SKIPN   4               ;it is caught on its stand
        WAIT    "THE GASKET DOES NOT COME UP: IT LIES OFF ITS PLACE"
        SEARCH  .05
LG:     MOVE    GON
        RESTORE E2 LEVEL
        STOP    [0 0 -24]
        CHANGE  [0 0 -1] 2.3
        SKIPN   23
        WAIT    "THE GASKET MEETS NOTHING: IT LIES REVERSED, OR IS LOST"
        TRAVEL  1.6 2.2         ;a gasket that stands on the pins stops high
        SKIPN   8
        AOJ     LG
        OPEN    1.9
        CHANGE  [0 0 1] 1
        MOVE    FACE
        OPEN    0
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .6 .1
        HEIGHT  BARE .04 .08    ;one gasket, .06 in thick
        SAVE    LAID            ;how high it lies
        CHANGE  [0 0 1] 1

        STAGE   "check the gasket"
        PARK
        LOOK    AFTER HOLD
        INSPECT PUMP BEFORE AFTER

        STAGE   "put on the top"
        OPEN    2.8
        MOVE    TOP
        CENTER  2
        CLOSE   2 2.4
        LOAD    36
        CHANGE  [0 0 1] 1
        SEARCH  .05
LT:     MOVE    TOPON
        RESTORE E1 LEVEL
        STOP    [0 0 -43]
        CHANGE  [0 0 -1] 2.3
        TRAVEL  1.7 2.1         ;a top that stands on the pins stops high
        SKIPN   8
        AOJ     LT
        LOAD    0
        OPEN    2.8
        CHANGE  [0 0 1] 3
        OPEN    0               ;before it goes down beside the pin
        MOVE    FLANGE          ;over its narrow end
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] .6 .1
        SKIPN   23
        WAIT    "NO TOP UNDER THE FINGERS: IT IS REVERSED OR LOST, OR ITS STAND HAS MOVED"
        HEIGHT  LAID .27 .33    ;its flange is .3 in thick: nothing is under it
        CHANGE  [0 0 1] 2       ;above the pins, before the hand opens

        STAGE   "drive the first two screws"
        OPEN    1.6
        MOVE    D
        CENTER  .5
        SAVE    DRV             ;where the driver really is across the fingers
        OPEN    2
        MOVE    DX
        RESTORE DRV
        CENTER  .5
        SAVE    DRX             ;and the other way
        OPEN    2
        MOVE    D
        RESTORE DRX
        RESTORE DRV
        CLOSE   .9 1.1
        CHANGE  [0 0 1] 2
        LOAD    15
        SEARCH  .05
M1:     MOVE    S1
        RESTORE DRX
        RESTORE DRV
        RESTORE DS LEVEL
        STOP    [0 0 -25]
        FREE    [1 1 0]         ;let the head guide the socket
        CHANGE  [0 0 -1] .5 .4
        SKIPN   23
        WAIT    "NO SCREW AT S1: IT IS MISSING, OR THE DISPENSER HAS MOVED, OR A JOINT READS WRONG"
        TRAVEL  .17 .40         ;socket over the head, or beside it?
        SKIPN   8
        AOJ     M1
        STOP    [0 0 -45]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .3 .2  ;and on to the head, where its edge has met the ring
        SAVE    DS
        CHANGE  [0 0 1] 1.5
        SEARCH  .05
K1:     MOVE    H0
        RESTORE Y1
        RESTORE X2
        STOP    [0 0 -30]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .45
        SKIPE   23              ;no resistance: the tip is in the hole
        AOJ     K1
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the hole guide the tip
        CHANGE  [0 0 -1] .48 .4 ;down to the thread
        SKIPN   23
        WAIT    "SCREW 1 IS NOT ON THE BIT"
        SAVE    HS
        TOOL    190
        TORQUE  42
        FORCE   [0 0 -22]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5     ;drive it until the torque stop
        SKIPN   24
        WAIT    "SCREW 1 MEETS NO TORQUE: ITS POINT, ITS THREAD OR THE BIT IS WRONG"
        TOOL    0
        TRAVEL  .2 .3           ;a crossed screw stops high, and so does one in a blocked hole
        SKIPN   8
        WAIT    "SCREW 1 STOPS HIGH: ITS THREAD IS CROSSED, OR ITS HOLE IS BLOCKED"
        CHANGE  [0 0 1] 1
        SEARCH  .05
M2:     MOVE    S2
        RESTORE DRX
        RESTORE DRV
        RESTORE DS LEVEL
        STOP    [0 0 -25]
        FREE    [1 1 0]         ;let the head guide the socket
        CHANGE  [0 0 -1] .5 .4
        SKIPN   23
        WAIT    "NO SCREW AT S2: IT IS MISSING, OR THE DISPENSER HAS MOVED, OR A JOINT READS WRONG"
        TRAVEL  .17 .40         ;socket over the head, or beside it?
        SKIPN   8
        AOJ     M2
        STOP    [0 0 -45]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .3 .2  ;and on to the head, where its edge has met the ring
        SAVE    DS
        CHANGE  [0 0 1] 1.5
        SEARCH  .05
K2:     MOVE    H2
        RESTORE Y1
        RESTORE X2
        RESTORE HS LEVEL        ;one hole found helps to find the others
        STOP    [0 0 -30]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .45
        SKIPE   23              ;no resistance: the tip is in the hole
        AOJ     K2
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the hole guide the tip
        CHANGE  [0 0 -1] .48 .4 ;down to the thread
        SKIPN   23
        WAIT    "SCREW 2 IS NOT ON THE BIT"
        HEIGHT  HS -.06 .06     ;as high as the one before
        SKIPN   9
        WAIT    "SCREW 2 STANDS WRONG: ITS LENGTH, ITS POINT OR ITS HOLE IS WRONG"
        SAVE    HS
        TOOL    190
        TORQUE  42
        FORCE   [0 0 -22]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5     ;drive it until the torque stop
        SKIPN   24
        WAIT    "SCREW 2 MEETS NO TORQUE: ITS POINT, ITS THREAD OR THE BIT IS WRONG"
        TOOL    0
        TRAVEL  .2 .3           ;a crossed screw stops high, and so does one in a blocked hole
        SKIPN   8
        WAIT    "SCREW 2 STOPS HIGH: ITS THREAD IS CROSSED, OR ITS HOLE IS BLOCKED"
        CHANGE  [0 0 1] 1
        SEARCH  .07
D1:     MOVE    DUP
        RESTORE DRX
        RESTORE DRV
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the guides guide it
        CHANGE  [0 0 -1] 2.4    ;straight into the rack until it stands
        TRAVEL  2 2.25          ;on the guides it would stand higher
        SKIPN   8
        AOJ     D1
        LOAD    0
        OPEN    1.6
        CHANGE  [0 0 1] 2

        STAGE   "take out the aligning pins"
        OPEN    .6
        MOVE    Q1
        RESTORE E1 LEVEL
        RESTORE HS LEVEL        ;how far the base has moved since, by the hole of the last screw
        CLOSE   .1
        CHANGE  [0 0 1] 2
        SEARCH  .05
R1:     MOVE    P1UP
        RESTORE C1 LEVEL
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the hole guide the pin
        CHANGE  [0 0 -1] 1.2
        TRAVEL  .7 1.1          ;home, or on top of the holder?
        SKIPN   8
        AOJ     R1
        OPEN    1
        OPEN    .6
        MOVE    Q2
        RESTORE E2 LEVEL
        RESTORE HS LEVEL
        CLOSE   .1
        CHANGE  [0 0 1] 2
        SEARCH  .05
R2:     MOVE    P2UP
        RESTORE C2 LEVEL
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the hole guide the pin
        CHANGE  [0 0 -1] 1.2
        TRAVEL  .7 1.1          ;home, or on top of the holder?
        SKIPN   8
        AOJ     R2
        OPEN    1

        STAGE   "drive the last four screws"
        OPEN    1.6
        MOVE    D
        CENTER  .5
        SAVE    DRV             ;where the driver really is across the fingers
        OPEN    2
        MOVE    DX
        RESTORE DRV
        CENTER  .5
        SAVE    DRX             ;and the other way
        OPEN    2
        MOVE    D
        RESTORE DRX
        RESTORE DRV
        CLOSE   .9 1.1
        CHANGE  [0 0 1] 2
        LOAD    15
        SEARCH  .05
M3:     MOVE    S3
        RESTORE DRX
        RESTORE DRV
        RESTORE DS LEVEL
        STOP    [0 0 -25]
        FREE    [1 1 0]         ;let the head guide the socket
        CHANGE  [0 0 -1] .5 .4
        SKIPN   23
        WAIT    "NO SCREW AT S3: IT IS MISSING, OR THE DISPENSER HAS MOVED, OR A JOINT READS WRONG"
        TRAVEL  .17 .40         ;socket over the head, or beside it?
        SKIPN   8
        AOJ     M3
        STOP    [0 0 -45]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .3 .2  ;and on to the head, where its edge has met the ring
        SAVE    DS
        CHANGE  [0 0 1] 1.5
        SEARCH  .05
K3:     MOVE    H5
        RESTORE Y1
        RESTORE X2
        RESTORE HS LEVEL        ;one hole found helps to find the others
        STOP    [0 0 -30]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .45
        SKIPE   23              ;no resistance: the tip is in the hole
        AOJ     K3
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the hole guide the tip
        CHANGE  [0 0 -1] .48 .4 ;down to the thread
        SKIPN   23
        WAIT    "SCREW 3 IS NOT ON THE BIT"
        HEIGHT  HS -.06 .06     ;as high as the one before
        SKIPN   9
        WAIT    "SCREW 3 STANDS WRONG: ITS LENGTH, ITS POINT OR ITS HOLE IS WRONG"
        SAVE    HS
        TOOL    190
        TORQUE  42
        FORCE   [0 0 -22]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5     ;drive it until the torque stop
        SKIPN   24
        WAIT    "SCREW 3 MEETS NO TORQUE: ITS POINT, ITS THREAD OR THE BIT IS WRONG"
        TOOL    0
        TRAVEL  .2 .3           ;a crossed screw stops high, and so does one in a blocked hole
        SKIPN   8
        WAIT    "SCREW 3 STOPS HIGH: ITS THREAD IS CROSSED, OR ITS HOLE IS BLOCKED"
        CHANGE  [0 0 1] 1
        SEARCH  .05
M4:     MOVE    S4
        RESTORE DRX
        RESTORE DRV
        RESTORE DS LEVEL
        STOP    [0 0 -25]
        FREE    [1 1 0]         ;let the head guide the socket
        CHANGE  [0 0 -1] .5 .4
        SKIPN   23
        WAIT    "NO SCREW AT S4: IT IS MISSING, OR THE DISPENSER HAS MOVED, OR A JOINT READS WRONG"
        TRAVEL  .17 .40         ;socket over the head, or beside it?
        SKIPN   8
        AOJ     M4
        STOP    [0 0 -45]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .3 .2  ;and on to the head, where its edge has met the ring
        SAVE    DS
        CHANGE  [0 0 1] 1.5
        SEARCH  .05
K4:     MOVE    H1
        RESTORE Y1
        RESTORE X2
        RESTORE HS LEVEL        ;one hole found helps to find the others
        STOP    [0 0 -30]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .45
        SKIPE   23              ;no resistance: the tip is in the hole
        AOJ     K4
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the hole guide the tip
        CHANGE  [0 0 -1] .48 .4 ;down to the thread
        SKIPN   23
        WAIT    "SCREW 4 IS NOT ON THE BIT"
        HEIGHT  HS -.06 .06     ;as high as the one before
        SKIPN   9
        WAIT    "SCREW 4 STANDS WRONG: ITS LENGTH, ITS POINT OR ITS HOLE IS WRONG"
        SAVE    HS
        TOOL    190
        TORQUE  42
        FORCE   [0 0 -22]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5     ;drive it until the torque stop
        SKIPN   24
        WAIT    "SCREW 4 MEETS NO TORQUE: ITS POINT, ITS THREAD OR THE BIT IS WRONG"
        TOOL    0
        TRAVEL  .2 .3           ;a crossed screw stops high, and so does one in a blocked hole
        SKIPN   8
        WAIT    "SCREW 4 STOPS HIGH: ITS THREAD IS CROSSED, OR ITS HOLE IS BLOCKED"
        CHANGE  [0 0 1] 1
        SEARCH  .05
M5:     MOVE    S5
        RESTORE DRX
        RESTORE DRV
        RESTORE DS LEVEL
        STOP    [0 0 -25]
        FREE    [1 1 0]         ;let the head guide the socket
        CHANGE  [0 0 -1] .5 .4
        SKIPN   23
        WAIT    "NO SCREW AT S5: IT IS MISSING, OR THE DISPENSER HAS MOVED, OR A JOINT READS WRONG"
        TRAVEL  .17 .40         ;socket over the head, or beside it?
        SKIPN   8
        AOJ     M5
        STOP    [0 0 -45]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .3 .2  ;and on to the head, where its edge has met the ring
        SAVE    DS
        CHANGE  [0 0 1] 1.5
        SEARCH  .05
K5:     MOVE    H4
        RESTORE Y1
        RESTORE X2
        RESTORE HS LEVEL        ;one hole found helps to find the others
        STOP    [0 0 -30]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .45
        SKIPE   23              ;no resistance: the tip is in the hole
        AOJ     K5
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the hole guide the tip
        CHANGE  [0 0 -1] .48 .4 ;down to the thread
        SKIPN   23
        WAIT    "SCREW 5 IS NOT ON THE BIT"
        HEIGHT  HS -.06 .06     ;as high as the one before
        SKIPN   9
        WAIT    "SCREW 5 STANDS WRONG: ITS LENGTH, ITS POINT OR ITS HOLE IS WRONG"
        SAVE    HS
        TOOL    190
        TORQUE  42
        FORCE   [0 0 -22]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5     ;drive it until the torque stop
        SKIPN   24
        WAIT    "SCREW 5 MEETS NO TORQUE: ITS POINT, ITS THREAD OR THE BIT IS WRONG"
        TOOL    0
        TRAVEL  .2 .3           ;a crossed screw stops high, and so does one in a blocked hole
        SKIPN   8
        WAIT    "SCREW 5 STOPS HIGH: ITS THREAD IS CROSSED, OR ITS HOLE IS BLOCKED"
        CHANGE  [0 0 1] 1
        SEARCH  .05
M6:     MOVE    S6
        RESTORE DRX
        RESTORE DRV
        RESTORE DS LEVEL
        STOP    [0 0 -25]
        FREE    [1 1 0]         ;let the head guide the socket
        CHANGE  [0 0 -1] .5 .4
        SKIPN   23
        WAIT    "NO SCREW AT S6: IT IS MISSING, OR THE DISPENSER HAS MOVED, OR A JOINT READS WRONG"
        TRAVEL  .17 .40         ;socket over the head, or beside it?
        SKIPN   8
        AOJ     M6
        STOP    [0 0 -45]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .3 .2  ;and on to the head, where its edge has met the ring
        SAVE    DS
        CHANGE  [0 0 1] 1.5
        SEARCH  .05
K6:     MOVE    H3
        RESTORE Y1
        RESTORE X2
        RESTORE HS LEVEL        ;one hole found helps to find the others
        STOP    [0 0 -30]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .45
        SKIPE   23              ;no resistance: the tip is in the hole
        AOJ     K6
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the hole guide the tip
        CHANGE  [0 0 -1] .48 .4 ;down to the thread
        SKIPN   23
        WAIT    "SCREW 6 IS NOT ON THE BIT"
        HEIGHT  HS -.06 .06     ;as high as the one before
        SKIPN   9
        WAIT    "SCREW 6 STANDS WRONG: ITS LENGTH, ITS POINT OR ITS HOLE IS WRONG"
        SAVE    HS
        TOOL    190
        TORQUE  42
        FORCE   [0 0 -22]
        FREE    [1 1 0]
        CHANGE  [0 0 -1] .5     ;drive it until the torque stop
        SKIPN   24
        WAIT    "SCREW 6 MEETS NO TORQUE: ITS POINT, ITS THREAD OR THE BIT IS WRONG"
        TOOL    0
        TRAVEL  .2 .3           ;a crossed screw stops high, and so does one in a blocked hole
        SKIPN   8
        WAIT    "SCREW 6 STOPS HIGH: ITS THREAD IS CROSSED, OR ITS HOLE IS BLOCKED"
        CHANGE  [0 0 1] 1
        SEARCH  .07
D2:     MOVE    DUP
        RESTORE DRX
        RESTORE DRV
        STOP    [0 0 -30]
        FREE    [1 1 0]         ;let the guides guide it
        CHANGE  [0 0 -1] 2.4    ;straight into the rack until it stands
        TRAVEL  2 2.25          ;on the guides it would stand higher
        SKIPN   8
        AOJ     D2
        LOAD    0
        OPEN    1.6
        CHANGE  [0 0 1] 2

        STAGE   "turn the rotor"
        OPEN    .9
        MOVE    CRANK
        RESTORE Y1
        RESTORE X2
        CENTER  .3
        OPEN    .44             ;an open fork: it pushes and does not pinch
        STOP    40
        TURN    ROTOR 60
        SKIPE   23              ;it should meet no such resistance
        WAIT    "THE ROTOR IS HARD TO TURN, OR A JOINT OF THE ARM IS"
        OPEN    .9
        PARK
