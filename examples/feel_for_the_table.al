; The hand goes down on the table until it presses with 40 ounces.
TRANS   ABOVE [25 38 .5 90 90 0]
        STAGE   "feel for the table"
        OPEN    1
        MOVE    ABOVE
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] 1 .2
