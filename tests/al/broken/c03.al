; feel for the large hole of the base
        OPEN    1.775
        SEARCH  .2
LA:     MOVE    A
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] 1.5    ;one finger goes into the large
        hole, the other outside
        SKIPE   23
        AOJ     LA
        CENTER  .5
        SAVE    DA
        OPEN    1.775
        PARK
